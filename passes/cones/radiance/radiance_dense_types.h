// Levels of dense radiance voxels, shared by C++ (passes/cones/filter_voxels/dense.cpp) and GLSL
// (passes/cones/radiance/radiance_dense.glsl).
#ifndef VOXRAY_SHARED_RADIANCE_DENSE_TYPES_H
#define VOXRAY_SHARED_RADIANCE_DENSE_TYPES_H

#include "shaders/shared/types.h"

// Enough for grids of 2048 voxels along an axis.
#define RADIANCE_DENSE_LEVELS 12

VOXRAY_SHARED_BEGIN

struct DenseLevel {
    uvec3 resolution;
    uint first;  // Voxels of all finer levels.
};

VOXRAY_SHARED_END

#endif
