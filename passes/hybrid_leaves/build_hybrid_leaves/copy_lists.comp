// Copies the lists of unchanged leaves to their new items, and maps unchanged grids to their previous indices.
#include "passes/hybrid_leaves/build_hybrid_leaves/previous_arrays.glsl"

readonly buffer PreviousLeaf { uint leaf[]; } previousLeaf;
readonly buffer Counts { uint triangles[]; } counts;
writeonly buffer PreviousGrid { uint grid[]; } previousGrid;

void main() {
    const uint leaf = linearIndex();
    if (leaf >= push.count) return;
    const uint previous = previousLeaf.leaf[leaf], word = hybridLeaves.words.data[leaf];
    if (isEmptyLeaf(word)) return;
    if (previous == NO_PREVIOUS) {
        if (isGridLeaf(word)) previousGrid.grid[word & ~LEAF_IS_GRID] = NO_PREVIOUS;
        return;
    }
    const uint previousLeafWord = previousWord(push.words, previous);
    if (isGridLeaf(word)) {
        previousGrid.grid[word & ~LEAF_IS_GRID] = previousLeafWord & ~LEAF_IS_GRID;
        return;
    }
    const uint items = LIST_ITEMS(counts.triangles[leaf]);
    for (uint i = 0u; i < items; ++i)
        hybridLeaves.primitives.data[firstItem(word) + i] =
            LeafLists(push.primitives).data[firstItem(previousLeafWord) + i];
}
