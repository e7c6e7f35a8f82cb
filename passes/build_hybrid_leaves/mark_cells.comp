#version 460
#extension GL_GOOGLE_include_directive : require
// A walk's visitor: sets the bit of each cell that a triangle overlaps.
#include "passes/build_hybrid_leaves/grid_cells.glsl"

void visitCell(TriangleFragment cell, uint grid) {
    if (!passesAlphaMask(cell)) return;
    const GridBit at = gridBit(grid, cell.voxel);
    if ((hybridLeaves.gridBits.data[at.word] & at.bit) == 0u) atomicOr(hybridLeaves.gridBits.data[at.word], at.bit);
}

void visitFragment(TriangleFragment f) { visitCells(f); }
