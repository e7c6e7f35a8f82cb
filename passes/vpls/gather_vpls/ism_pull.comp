// Pull: a coarse texel is the mean of its known fine ones.
#include "passes/vpls/gather_vpls/map_levels.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

void main() {
    const uint i = linearIndex(), texelsPerMap = push.coarseResolution * push.coarseResolution, map = i / texelsPerMap;
    if (map >= push.mapCount) return;
    const ivec2 texel = ivec2(i % push.coarseResolution, i % texelsPerMap / push.coarseResolution);
    const ivec2 last = ivec2(push.fineResolution) - 1;
    float sum = 0.0, knownCount = 0.0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 child = 2 * texel + ivec2(k & 1, k >> 1);
        if (any(greaterThan(child, last))) continue;
        const float inverseDepth = fine.data[fineTexel(map, child)];
        sum += inverseDepth;
        knownCount += inverseDepth > 0.0 ? 1.0 : 0.0;
    }
    coarse.data[i] = knownCount > 0.0 ? sum / knownCount : 0.0;
}
