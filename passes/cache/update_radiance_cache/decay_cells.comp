// Copies the cells of the previous frame to this frame's table, each with 1 - 1 / historyFrames of its samples: an
// exponential moving average. Cells with less than a quarter of a sample are dropped.
#include "shaders/compute/linear_index.glsl"
#include "passes/cache/radiance_cache.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer OldKeys { uint64_t data[]; } oldKeys;
layout(scalar) readonly buffer OldSums { uint64_t data[]; } oldSums;
buffer CellCounts {
    uint cells;
    uint lost;
    uint collisions;
} cellCounts;
layout(push_constant) uniform Push { uint historyFrames; } push;

void main() {
    const uint old = linearIndex();
    const RadianceCacheGrid g = radianceCacheGrid.data;
    if (old >= g.capacity || oldKeys.data[old] == 0ul) return;
    uint64_t decayed[4];
    for (uint c = 0u; c < 4u; ++c) {
        const uint64_t sum = oldSums.data[4u * old + c];
        decayed[c] = sum - sum / uint64_t(push.historyFrames);
    }
    if (decayed[3] < uint64_t(RADIANCE_CACHE_SAMPLE_UNITS / 4u)) return;
    bool isNew;
    uint collisions;
    const uint slot = insertRadianceCell(g, oldKeys.data[old], isNew, collisions);
    if (slot == NO_CELL) {
        // Rounded up, so that every loss counts
        const uint64_t unit = uint64_t(RADIANCE_CACHE_SAMPLE_UNITS);
        atomicAdd(cellCounts.lost, uint((decayed[3] + unit - uint64_t(1)) / unit));
        return;
    }
    atomicAdd(cellCounts.cells, 1u);
    if (collisions > 0u) atomicAdd(cellCounts.collisions, collisions);
    for (uint c = 0u; c < 4u; ++c) radianceCacheSums.data[4u * slot + c] = decayed[c];
}
