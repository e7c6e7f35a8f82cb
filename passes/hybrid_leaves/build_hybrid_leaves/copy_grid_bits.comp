// Copies the occupancy of unchanged grids.
#include "passes/hybrid_leaves/build_hybrid_leaves/previous_arrays.glsl"

readonly buffer PreviousGrid { uint grid[]; } previousGrid;

void main() {
    const uint word = linearIndex(), perGrid = hybridLeaves.shape.wordsPerGrid;
    if (word >= push.count) return;
    const uint previous = previousGrid.grid[word / perGrid];
    if (previous != NO_PREVIOUS)
        hybridLeaves.gridBits.data[word] = previousWord(push.gridBits, previous * perGrid + word % perGrid);
}
