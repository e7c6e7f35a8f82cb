// A texel of the coarse level: the mean of what is known of its four.
#include "passes/vpls/gather_vpls/map_levels.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

void main() {
    const uint i = linearIndex(), perMap = push.coarseSide * push.coarseSide, map = i / perMap;
    if (map >= push.maps) return;
    const ivec2 texel = ivec2(i % push.coarseSide, i % perMap / push.coarseSide), last = ivec2(push.fineSide) - 1;
    float sum = 0.0, known = 0.0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 at = 2 * texel + ivec2(k & 1, k >> 1);
        if (any(greaterThan(at, last))) continue;
        const float inverse = fine.data[fineTexel(map, at)];
        sum += inverse;
        known += inverse > 0.0 ? 1.0 : 0.0;
    }
    coarse.data[i] = known > 0.0 ? sum / known : 0.0;
}
