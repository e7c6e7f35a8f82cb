// A vertex of a path that fills a radiance cache, shared by C++ and GLSL.
#ifndef VOXRAY_UPDATE_RADIANCE_CACHE_PATH_TYPES_H
#define VOXRAY_UPDATE_RADIANCE_CACHE_PATH_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A path vertex; its position and reflectance are in the surfel of the same index.
struct CachePathVertex {
    uvec2 key;       // Key of its cell.
    uint next;       // Next vertex of the path, or NO_VERTEX.
    float survival;  // Probability that the path continues (Russian roulette).
    vec3 fromCache;  // Irradiance from the cell that ended the path, W/m².
};

#define NO_VERTEX 0xffffffffu

VOXRAY_SHARED_END

#endif
