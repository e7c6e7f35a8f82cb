// Irradiance of a surface by a set of cones (passes/cones/radiance/cone_sets.h).
#ifndef VOXRAY_CONE_SET_GLSL
#define VOXRAY_CONE_SET_GLSL

#include "passes/cones/radiance/cone_direction.glsl"
#include "passes/cones/radiance/radiance_cone.glsl"

layout(scalar) readonly buffer Cones { Cone data[]; } cones;

// Irradiance, W/m², at `position` on a surface with unit geometric and unit shading normal, by the first `count` cones
// of the set. `dither`, three numbers in [0, 1): two for coneDirection(), and the shift of the cones' levels.
vec3 coneIrradiance(vec3 position, vec3 geometricNormal, vec3 normal, uint count, vec3 dither) {
    const ConeBase base = coneBase(position, geometricNormal, dither.z, 0.0);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < count; ++i) {
        const Cone cone = cones.data[i];
        const vec3 direction = coneDirection(cone, normal, dither.xy);
        // Cones that a normal map turns below the surface receive nothing.
        if (dot(direction, base.normal) <= 0.0) continue;
        sum += cone.weight * coneRadiance(base, direction, cone.width, dither.z - 0.5);
    }
    return PI * sum;
}

#endif
