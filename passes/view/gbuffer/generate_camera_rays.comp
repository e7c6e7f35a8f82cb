// One camera ray for each of a batch of texels.
#include "passes/view/gbuffer/view.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    View view;
    uint firstTexel;
    uint batchRays;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchRays) return;
    const uint texel = push.firstTexel + i;
    Ray ray;
    ray.origin = push.view.origin;
    ray.direction = viewDirection(push.view, uvec2(texel % push.view.width, texel / push.view.width));
    ray.tMin = 0.0;
    ray.tMax = 1.0e30;
    rays.data[i] = ray;
}
