// Headers of radiance voxels, shared by C++ (passes/cones/radiance/radiance_voxels.h) and GLSL
// (passes/cones/radiance/radiance_voxels.glsl).
#ifndef VOXRAY_SHARED_RADIANCE_TYPES_H
#define VOXRAY_SHARED_RADIANCE_TYPES_H

#include "shaders/shared/types.h"

// Enough for grids of 2048 voxels along an axis.
#define RADIANCE_DENSE_LEVELS 12
#define RADIANCE_CLIPMAP_LEVELS 12

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

// A level of the layout dense.
struct DenseLevel {
    uvec3 resolution;
    uint first;  // Voxels of all finer levels.
};

// The texture of the layout textures.
struct TextureLayout {
    uvec3 extent;  // Texels of one face in mip level 0: powers of two, since mip levels are rounded down and
                   // levels of voxels up.
    uvec3 along;   // 1 for the axis along which faces lie side by side, the grid's longest; 0 for the others.
};

// The window of a level: the box of its voxels that are stored.
struct ClipmapWindow {
    ivec3 first;      // Voxel of the level at the box's lower corner.
    uvec3 size;       // Voxels along each axis.
    uint firstIndex;  // Of the first voxel; the number of voxels of all finer levels.
    vec3 center;      // m
    vec3 reach;       // m from the center to where its weight in samples is 0; unbounded along axes that
                      // the window covers.
    float falloff;    // Decrease of that weight per metre before the reach ends.
};

VOXRAY_SHARED_END

#endif
