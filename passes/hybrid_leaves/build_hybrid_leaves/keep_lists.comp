// Copies the lists of kept leaves to their new places, and tells which grid each kept grid was. A thread takes a leaf.
#include "passes/hybrid_leaves/build_hybrid_leaves/kept_arrays.glsl"

readonly buffer KeptFrom { uint leaf[]; } keptFrom;
readonly buffer Counts { uint triangles[]; } counts;
writeonly buffer GridFrom { uint grid[]; } gridFrom;

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.count) return;
    const uint from = keptFrom.leaf[leaf], word = hybridLeaves.words.data[leaf];
    if (isEmptyLeaf(word)) return;
    if (from == NOT_KEPT) {
        if (isGridLeaf(word)) gridFrom.grid[word & ~LEAF_IS_GRID] = NOT_KEPT;
        return;
    }
    const uint before = previousWord(push.words, from);
    if (isGridLeaf(word)) {
        gridFrom.grid[word & ~LEAF_IS_GRID] = before & ~LEAF_IS_GRID;
        return;
    }
    const uint items = LIST_ITEMS(counts.triangles[leaf]);
    for (uint i = 0u; i < items; ++i)
        hybridLeaves.primitives.data[firstItem(word) + i] = LeafLists(push.primitives).data[firstItem(before) + i];
}
