// The ends of the rays through the near fields of a batch of cones, and what the cones find beyond.
#include "passes/cones/gather_cones/near_cones.glsl"
#include "passes/cones/gather_cones/near_end.glsl"
#include "passes/cones/radiance/cone_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Cones { Cone data[]; } cones;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchCones) return;
    light.data[i] = vec4(0.0);
    const ivec2 texel = texelOfCone(i);
    if (any(greaterThanEqual(texel, textureSize(position, 0)))) return;
    const vec3 side = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    const float dither = texelDither(texel).z;
    endRay(i, i, side, vec3(1.0), cones.data[i % push.conesPerTexel].width, push.range,
           push.firstPlace * push.conesPerTexel + i, vec2(dither));
}
