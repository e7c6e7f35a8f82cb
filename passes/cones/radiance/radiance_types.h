// What every layout of radiance voxels begins with, shared by C++ (passes/cones/radiance/radiance_voxels.h)
// and GLSL (passes/cones/radiance/radiance_voxels.glsl).
#ifndef VOXRAY_SHARED_RADIANCE_TYPES_H
#define VOXRAY_SHARED_RADIANCE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Levels of ever larger voxels in one place. Voxel (x, y, z) of level l spans origin + voxelSize * 2^l * [x,
// x+1] and so on; level 0 has the voxels of the grid that the surfaces were voxelized in, each further one
// half as many along each axis, rounded up, to a single voxel.
struct RadianceGrid {
    vec3 origin;       // m
    float voxelSize;   // m, of level 0.
    uvec3 resolution;  // Of level 0.
    uint levels;
    uint directions;  // Values a voxel: 6, by face (+x -x +y -y +z -z), or 1 for all.
    float unit;       // Radiance, W/(m² sr), that the stored number 1 stands for; a power of two.
};

VOXRAY_SHARED_END

#endif
