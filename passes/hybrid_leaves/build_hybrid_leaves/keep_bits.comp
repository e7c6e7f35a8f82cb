// Copies the bits of kept grids. A thread takes a word.
#include "passes/hybrid_leaves/build_hybrid_leaves/kept_arrays.glsl"

readonly buffer GridFrom { uint grid[]; } gridFrom;

void main() {
    const uint word = linearIndex(), perGrid = hybridLeaves.shape.wordsPerGrid;
    if (word >= push.count) return;
    const uint from = gridFrom.grid[word / perGrid];
    if (from != NOT_KEPT) hybridLeaves.gridBits.data[word] = previousWord(push.gridBits, from * perGrid + word % perGrid);
}
