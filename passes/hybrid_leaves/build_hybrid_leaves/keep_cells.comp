// Copies the cells of kept grids to their new places. A thread takes a word of grids' bits.
#include "passes/hybrid_leaves/build_hybrid_leaves/kept_arrays.glsl"

readonly buffer GridFrom { uint grid[]; } gridFrom;

void main() {
    const uint word = linearIndex(), perGrid = hybridLeaves.shape.wordsPerGrid, cellWords = hybridLeaves.shape.cellWords;
    if (word >= push.count) return;
    const uint from = gridFrom.grid[word / perGrid], bits = hybridLeaves.gridBits.data[word];
    if (from == NOT_KEPT || bits == 0u) return;
    const uint before = previousWord(push.gridRanks, from * perGrid + word % perGrid) * cellWords;
    const uint now = hybridLeaves.gridRanks.data[word] * cellWords, words = uint(bitCount(bits)) * cellWords;
    for (uint i = 0u; i < words; ++i) hybridLeaves.cells.data[now + i] = previousWord(push.cells, before + i);
}
