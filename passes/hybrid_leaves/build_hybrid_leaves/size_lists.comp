// The length of each leaf's list; leaves with more triangles than the capacity have a grid instead.
#include "passes/hybrid_leaves/build_hybrid_leaves/leaves_push.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"

readonly buffer Counts { uint triangles[]; } counts;
readonly buffer RebuiltCounts { uint triangles[]; } rebuiltCounts;  // 0 for unchanged leaves.
writeonly buffer Sizes { uint items[]; } sizes;
writeonly buffer Grids { uint isGrid[]; } grids;
buffer LeafStatistics {
    uint empty;
    uint maxTriangles;  // Of a leaf.
    uint pairs;         // Of a triangle and a rebuilt leaf with a grid.
    uint listed;        // Triangles in lists.
} statistics;

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.leaves) return;
    const uint count = counts.triangles[leaf];
    sizes.items[leaf] = count <= push.capacity ? LIST_ITEMS(count) : 0u;
    if (count <= push.capacity) atomicAdd(statistics.listed, count);
    grids.isGrid[leaf] = count > push.capacity ? 1u : 0u;
    if (count == 0u) atomicAdd(statistics.empty, 1u);
    if (count > push.capacity) atomicAdd(statistics.pairs, rebuiltCounts.triangles[leaf]);
    atomicMax(statistics.maxTriangles, count);
}
