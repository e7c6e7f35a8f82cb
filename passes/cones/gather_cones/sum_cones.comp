// Irradiance of each traced texel of a batch: the weighted sum of its cones.
#include "passes/cones/radiance/cone_ray_batch.glsl"
#include "passes/cones/radiance/cone_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Cones { Cone data[]; } cones;
layout(scalar) readonly buffer Light { vec4 data[]; } light;
layout(rgba32f) writeonly uniform image2D irradiance;

void main() {
    const uint first = linearIndex() * push.conesPerTexel;
    if (first >= push.batchCones) return;
    vec3 sum = vec3(0.0);
    for (uint j = 0u; j < push.conesPerTexel; ++j) sum += cones.data[j].weight * light.data[first + j].rgb;
    const uint traced = push.firstTexel + first / push.conesPerTexel;
    imageStore(irradiance, ivec2(traced % push.tracedExtent.x, traced / push.tracedExtent.x), vec4(sum, 1.0));
}
