// A vertex of a path that fills a radiance cache, shared by C++ and GLSL.
#ifndef VOXRAY_UPDATE_RADIANCE_CACHE_PATH_TYPES_H
#define VOXRAY_UPDATE_RADIANCE_CACHE_PATH_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// What a path keeps of a vertex besides its surfel.
struct PathVertex {
    uvec2 key;       // Of the cell that it lies in; 0 where it leaves nothing.
    uint next;       // The vertex that its ray hit, or NO_VERTEX.
    float survival;  // Probability that a ray goes on from it.
    vec3 fromCache;  // Irradiance by its ray, where that ended in the cache, W/m².
};

#define NO_VERTEX 0xffffffffu

VOXRAY_SHARED_END

#endif
