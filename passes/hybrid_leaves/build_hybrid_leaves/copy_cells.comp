// Copies the cells of unchanged grids to their new indices. One invocation per occupancy word.
#include "passes/hybrid_leaves/build_hybrid_leaves/previous_arrays.glsl"

readonly buffer PreviousGrid { uint grid[]; } previousGrid;

void main() {
    const uint word = linearIndex(), perGrid = hybridLeaves.shape.wordsPerGrid,
               cellWords = hybridLeaves.shape.cellWords;
    if (word >= push.count) return;
    const uint previous = previousGrid.grid[word / perGrid], bits = hybridLeaves.gridBits.data[word];
    if (previous == NO_PREVIOUS || bits == 0u) return;
    const uint firstPrevious = previousWord(push.gridRanks, previous * perGrid + word % perGrid) * cellWords;
    const uint first = hybridLeaves.gridRanks.data[word] * cellWords, words = uint(bitCount(bits)) * cellWords;
    for (uint i = 0u; i < words; ++i) hybridLeaves.cells.data[first + i] = previousWord(push.cells, firstPrevious + i);
}
