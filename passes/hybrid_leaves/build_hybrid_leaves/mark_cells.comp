// Sets the bit of each cell that a triangle overlaps, at all levels.
#include "passes/hybrid_leaves/build_hybrid_leaves/grid_cells.glsl"

void visitFragment(TriangleFragment cell) {
    if (!passesAlphaMask(cell)) return;
    for (uint level = 0u; level < hybridLeaves.shape.gridLevels; ++level) {
        const GridBit at = gridBit(gridLevel(cellGrid, level), cell.voxel >> level);
        if ((hybridLeaves.gridBits.data[at.word] & at.bit) == 0u) atomicOr(hybridLeaves.gridBits.data[at.word], at.bit);
    }
}
