// Resolves the rays along the cones of a batch.
#include "passes/cones/radiance/cone_ray_batch.glsl"
#include "passes/cones/gather_cones/resolve_cone_ray.glsl"
#include "passes/cones/radiance/cone_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Cones { Cone data[]; } cones;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchCones) return;
    light.data[i] = vec4(0.0);
    const ivec2 texel = texelOfCone(i);
    if (any(greaterThanEqual(texel, textureSize(position, 0)))) return;
    const vec3 ng = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    const float dither = texelDither(texel).z;
    resolveConeRay(i, i, ng, vec3(1.0), cones.data[i % push.conesPerTexel].width, push.range,
                        push.firstTexel * push.conesPerTexel + i, vec2(dither));
}
