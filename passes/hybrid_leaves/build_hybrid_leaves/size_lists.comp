// How long each leaf's list is, and whether it has a grid instead: where it has more triangles than the capacity. A thread takes a leaf.
#include "passes/hybrid_leaves/build_hybrid_leaves/leaves_push.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"

readonly buffer Counts { uint triangles[]; } counts;
readonly buffer Counted { uint triangles[]; } counted;  // Of leaves that are built, 0 of those that are kept.
writeonly buffer Sizes { uint items[]; } sizes;
writeonly buffer Grids { uint isGrid[]; } grids;
buffer Found {
    uint empty;
    uint maxTriangles;  // Of a leaf.
    uint pairs;         // Of a triangle and a leaf with a grid that is built.
    uint listed;        // Triangles in lists.
} found;

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.leaves) return;
    const uint count = counts.triangles[leaf];
    sizes.items[leaf] = count <= push.capacity ? LIST_ITEMS(count) : 0u;
    if (count <= push.capacity) atomicAdd(found.listed, count);
    grids.isGrid[leaf] = count > push.capacity ? 1u : 0u;
    if (count == 0u) atomicAdd(found.empty, 1u);
    if (count > push.capacity) atomicAdd(found.pairs, counted.triangles[leaf]);
    atomicMax(found.maxTriangles, count);
}
