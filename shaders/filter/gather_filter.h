// What guides the filter of gather_rays, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_GATHER_FILTER_H
#define VOXRAY_SHARED_GATHER_FILTER_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Sums over the rays of a block. L: a ray's luminance; 1/r: the inverse distance of its hit, 1/m, 0 for a miss.
struct GatherMoments {
    float rays;
    float luminance;
    float squared;       // L²
    float nearness;      // 1/r
    float nearLuminance; // L/r
    float nearSquared;   // L²/r
};

// A texel of the G-buffer, as the filter sees it.
struct FilterTexel {
    vec3 position;   // m
    uint normal;     // Octahedral, 2 x 16 bits.
    float change;    // Bound of the relative change of irradiance along the surface, 1/m; negative: no surface.
    float variance;  // Of a ray over its squared mean.
};

VOXRAY_SHARED_END

#endif
