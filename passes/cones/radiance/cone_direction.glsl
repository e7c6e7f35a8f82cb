// Directions of the cones of a set (passes/cones/radiance/cone_sets.h).
#ifndef VOXRAY_CONE_DIRECTION_GLSL
#define VOXRAY_CONE_DIRECTION_GLSL

#include "passes/cones/radiance/cone_types.h"
#include "shaders/scene/sampling.glsl"

// Axis of a cone of the set about the unit normal. `dither`, two numbers in [0, 1): position in its stratum (azimuth,
// then angle from the normal).
vec3 coneDirection(Cone cone, vec3 normal, vec2 dither) {
    vec3 tangent, bitangent;
    frame(normal, tangent, bitangent);
    const float sine = sqrt(mix(cone.sineSquared.x, cone.sineSquared.y, dither.y));
    const float azimuth = cone.azimuth + 2.0 * PI * dither.x;
    return normalize(sine * (cos(azimuth) * tangent + sin(azimuth) * bitangent) + sqrt(1.0 - sine * sine) * normal);
}

#endif
