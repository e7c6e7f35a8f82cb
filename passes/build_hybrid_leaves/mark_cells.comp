#version 460
#extension GL_GOOGLE_include_directive : require
// Sets the bit of each cell that a triangle overlaps.
#include "passes/build_hybrid_leaves/grid_cells.glsl"

void visitFragment(TriangleFragment cell) {
    if (!passesAlphaMask(cell)) return;
    const GridBit at = gridBit(cellGrid, cell.voxel);
    if ((hybridLeaves.gridBits.data[at.word] & at.bit) == 0u) atomicOr(hybridLeaves.gridBits.data[at.word], at.bit);
}
