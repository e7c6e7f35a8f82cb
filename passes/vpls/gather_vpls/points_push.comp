// A texel of the fine level that nothing is known of: what is known of the four coarse ones round it, weighed bilinearly. Inverse depth
// along an axis of the octahedron is linear over a flat surface, so that there the hole is filled by what it lacks.
#include "passes/vpls/gather_vpls/map_levels.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

void main() {
    const uint i = linearIndex(), perMap = push.fineSide * push.fineSide, map = i / perMap;
    if (map >= push.maps || fine.data[i] > 0.0) return;
    const ivec2 texel = ivec2(i % push.fineSide, i % perMap / push.fineSide), last = ivec2(push.coarseSide) - 1;
    // Its own, and those on the sides of it that it lies on
    const ivec2 own = texel / 2, side = 2 * (texel & 1) - 1;
    float sum = 0.0, weights = 0.0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 at = own + side * ivec2(k & 1, k >> 1);
        if (any(lessThan(at, ivec2(0))) || any(greaterThan(at, last))) continue;
        const float inverse = coarse.data[coarseTexel(map, at)], weight = ((k & 1) == 0 ? 3.0 : 1.0) * (k < 2 ? 3.0 : 1.0);
        if (inverse == 0.0) continue;
        sum += weight * inverse;
        weights += weight;
    }
    if (weights > 0.0) fine.data[i] = sum / weights;
}
