// A face of a cluster component, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_COMPONENT_FACE_TYPES_H
#define VOXRAY_SHARED_COMPONENT_FACE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct ComponentFace {
    uint number;      // 6 * component + face.
    uint patchCount;  // Number of the component's patches at this face.
    float area;       // Sum over these, in units of a voxel's face.
};

VOXRAY_SHARED_END

#endif
