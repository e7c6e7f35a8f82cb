// Irradiance of a surface by a set of cones (passes/common/radiance/cone_sets.h). Needs those of shaders/radiance/radiance_cone.glsl.
#ifndef VOXRAY_CONE_SET_GLSL
#define VOXRAY_CONE_SET_GLSL

#include "shaders/radiance/radiance_cone.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/radiance/cone_types.h"

layout(scalar) readonly buffer Cones { Cone data[]; } cones;

// W/m² at `position` on a surface with unit normal `side` and unit shading normal `normal`. `dither`, three numbers in [0, 1): where
// in their cells the first `count` cones stand (azimuth, then angle from the normal), and how their levels are shifted, the first one included.
vec3 coneIrradiance(vec3 position, vec3 side, vec3 normal, uint count, vec3 dither) {
    const ConeBase base = coneBase(position, side, dither.z);
    vec3 tangent, bitangent;
    frame(normal, tangent, bitangent);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < count; ++i) {
        const Cone cone = cones.data[i];
        const float sine = sqrt(mix(cone.sineSquared.x, cone.sineSquared.y, dither.y));
        const float azimuth = cone.azimuth + 2.0 * PI * dither.x;
        const vec3 direction = normalize(sine * (cos(azimuth) * tangent + sin(azimuth) * bitangent) + sqrt(1.0 - sine * sine) * normal);
        // A normal map may point cones below the surface: those see the surface itself, which reflects nothing to it.
        if (dot(direction, base.side) <= 0.0) continue;
        sum += cone.weight * coneRadiance(base, direction, cone.width, dither.z - 0.5);
    }
    return PI * sum;
}

#endif
