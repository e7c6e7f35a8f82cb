// Counts the links of each class that wait.
#include "passes/radiosity/link_surfels/waiting_links.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

buffer ClassCounts { uint data[]; } classCounts;
layout(push_constant) uniform Push {
    uint words;
    uint wordsPerSurfel;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.words) return;
    const uint group = linkGroup(i / push.wordsPerSurfel), firstRay = i % push.wordsPerSurfel * 32u;
    uint bits = waiting.data[i];
    while (bits != 0u) atomicAdd(classCounts.data[(firstRay + takeBit(bits)) * LINK_GROUPS + group], 1u);
}
