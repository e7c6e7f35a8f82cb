// A face of a cluster component, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_COMPONENT_FACE_TYPES_H
#define VOXRAY_SHARED_COMPONENT_FACE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct ComponentFace {
    float area;       // Sum over its patches, in units of a voxel's face.
    uint patchCount;  // Number of the component's patches at this face.
};

VOXRAY_SHARED_END

#endif
