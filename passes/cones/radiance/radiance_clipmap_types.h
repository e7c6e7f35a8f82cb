// Levels of a radiance clipmap, shared by C++ (passes/cones/clipmap/radiance_clipmap.h) and GLSL
// (passes/cones/radiance/radiance_clipmap.glsl).
#ifndef VOXRAY_SHARED_RADIANCE_CLIPMAP_TYPES_H
#define VOXRAY_SHARED_RADIANCE_CLIPMAP_TYPES_H

#include "shaders/shared/types.h"

// Enough for grids of 2048 voxels along an axis.
#define RADIANCE_CLIPMAP_LEVELS 12

VOXRAY_SHARED_BEGIN

// The window of a level: the box of its voxels that are stored.
struct ClipmapWindow {
    ivec3 first;      // Voxel of the level at the box's lower corner.
    uvec3 size;       // Voxels along each axis.
    uint firstIndex;  // Of the first voxel; the number of voxels of all finer levels.
    vec3 center;      // m
    vec3 reach;       // m from the center to where its weight in samples is 0; unbounded along axes that are
                      // held whole.
    float falloff;    // Decrease of that weight per metre before the reach ends.
};

VOXRAY_SHARED_END

#endif
