// Generates a batch of gather rays.
#include "shaders/compute/linear_index.glsl"
#include "shaders/view/gather_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
} push;

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.batchBlocks * g.raysPerBlock) return;
    rays.data[i] = gatherRay(g, push.firstBlock + i / g.raysPerBlock, i % g.raysPerBlock);
}
