// Push: an unknown fine texel is interpolated bilinearly from the known ones of the four coarse texels around it.
// Inverse depth along an axis of the octahedron is linear on a flat surface, so that holes there are filled exactly.
#include "passes/vpls/gather_vpls/map_levels.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

void main() {
    const uint i = linearIndex(), texelsPerMap = push.fineResolution * push.fineResolution, map = i / texelsPerMap;
    if (map >= push.mapCount || fine.data[i] > 0.0) return;
    const ivec2 texel = ivec2(i % push.fineResolution, i % texelsPerMap / push.fineResolution);
    const ivec2 last = ivec2(push.coarseResolution) - 1;
    // The texel's parent, and the parent's neighbors that are nearest to it
    const ivec2 parent = texel / 2, neighborOffset = 2 * (texel & 1) - 1;
    float sum = 0.0, weights = 0.0;
    for (int k = 0; k < 4; ++k) {
        const ivec2 neighbor = parent + neighborOffset * ivec2(k & 1, k >> 1);
        if (any(lessThan(neighbor, ivec2(0))) || any(greaterThan(neighbor, last))) continue;
        const float inverseDepth = coarse.data[coarseTexel(map, neighbor)];
        const float weight = ((k & 1) == 0 ? 3.0 : 1.0) * (k < 2 ? 3.0 : 1.0);
        if (inverseDepth == 0.0) continue;
        sum += weight * inverseDepth;
        weights += weight;
    }
    if (weights > 0.0) fine.data[i] = sum / weights;
}
