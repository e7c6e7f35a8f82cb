// A face of a cluster's part, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_PART_FACE_TYPES_H
#define VOXRAY_SHARED_PART_FACE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct PartFace {
    float area;    // Of its patches that open space lies before, in faces of a voxel.
    uint patches;  // How many it has.
};

VOXRAY_SHARED_END

#endif
