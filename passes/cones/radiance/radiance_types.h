// Header of all layouts of radiance voxels, shared by C++ (passes/cones/radiance/radiance_voxels.h)
// and GLSL (passes/cones/radiance/radiance_voxels.glsl).
#ifndef VOXRAY_SHARED_RADIANCE_TYPES_H
#define VOXRAY_SHARED_RADIANCE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A pyramid of grids. Voxel (x, y, z) of level l spans origin + voxelSize * 2^l * [x, x+1] and so on; level 0
// is the grid of the surface voxels, each coarser one has half as many voxels along each axis, rounded up,
// down to a single voxel.
struct RadianceGrid {
    vec3 origin;       // m
    float voxelSize;   // m, of level 0.
    uvec3 resolution;  // Of level 0.
    uint levels;
    uint directions;  // Values per voxel: 6, by face (+x -x +y -y +z -z), or 1 for all.
    float unit;       // Radiance, W/(m² sr), of the stored number 1; a power of two.
};

VOXRAY_SHARED_END

#endif
