// What guides the filter at a texel of the G-buffer, shared by C++ and GLSL.
#ifndef VOXRAY_FILTER_TYPES_H
#define VOXRAY_FILTER_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// What the rays around a block tell of the light there.
struct RayStatistics {
    float gradient;  // Bound of the relative change of irradiance along a surface, 1/m.
    float variance;  // Of a single ray, over its squared mean.
};

struct FilterTexel {
    vec3 position;         // m
    uint normal;           // Octahedral, 2 x 16 bits.
    uint geometricNormal;  // Likewise.
    float
        gradient;  // Bound of the relative change of irradiance along the surface, 1/m; negative: no surface.
    float variance;  // Of a single ray, over its squared mean.
};

VOXRAY_SHARED_END

#endif
