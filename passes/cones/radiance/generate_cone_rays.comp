// Generates a ray along the axis of each cone of a batch.
#include "passes/cones/radiance/cone_ray_batch.glsl"
#include "passes/cones/radiance/cone_direction.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Cones { Cone data[]; } cones;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchCones) return;
    const ivec2 texel = texelOfCone(i);
    rays.data[i] = kNoRay;
    if (any(greaterThanEqual(texel, textureSize(position, 0)))) return;
    const vec4 p = texelFetch(position, texel, 0);
    if (p.w == 0.0) return;
    const vec3 ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    const vec3 ns = normalize(texelFetch(normal, texel, 0).xyz);
    const vec3 direction = coneDirection(cones.data[i % push.conesPerTexel], ns, directionDither(texel));
    // Cones that a normal map turns below the surface receive nothing.
    if (dot(direction, ng) > 0.0) rays.data[i] = Ray(p.xyz + ng * p.w, 0.0, direction, push.rayLength);
}
