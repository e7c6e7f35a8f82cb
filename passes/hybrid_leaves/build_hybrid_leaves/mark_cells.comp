// Sets the occupancy of the cells that a triangle overlaps, at all levels.
#include "passes/hybrid_leaves/build_hybrid_leaves/voxelize_in_leaf.glsl"

void processFragment(TriangleFragment cell) {
    if (!passesAlphaMask(cell)) return;
    for (uint level = 0u; level < hybridLeaves.shape.gridLevels; ++level) {
        const GridBit cellBit = gridBit(gridLevel(cellGrid, level), cell.voxel >> level);
        if ((hybridLeaves.gridBits.data[cellBit.word] & cellBit.bit) == 0u)
            atomicOr(hybridLeaves.gridBits.data[cellBit.word], cellBit.bit);
    }
}
