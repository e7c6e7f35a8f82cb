// Chooses gather rays, and lists the paths that go on from their hits.
#include "passes/final_gather/residual_rays/chosen_rays.glsl"
#include "passes/path_trace/path_streams/begin_path.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/view/gather_ray.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) buffer Chosen { uint count; } chosen;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
    float probability;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rays || hits.data[i].triangle == NO_HIT) return;
    const uint blockIndex = push.firstBlock + i / push.layout_.raysPerBlock, j = i % push.layout_.raysPerBlock;
    if (choiceOf(push.layout_, blockIndex, j).x >= push.probability) return;
    atomicAdd(chosen.count, 1u);
    beginPath(i, gatherRay(push.layout_, blockIndex, j), hits.data[i]);
}
