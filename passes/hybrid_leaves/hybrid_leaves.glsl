// Leaves of a hybrid octree (Seok 2021, section 3.1; docs/hybrid-leaves.md): each surface voxel is a leaf with a list
// of its triangles or, where these are many, a grid of finer voxels, its cells. Leaves have the indices of surface
// voxels (voxelNumber() of shaders/voxels/voxels.glsl).
#ifndef VOXRAY_HYBRID_LEAVES_GLSL
#define VOXRAY_HYBRID_LEAVES_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"

struct ListItem {
    uint box;  // Packed (leaf_box.glsl), with LIST_ENDS.
    uint triangle;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LeafLists { ListItem data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TriangleCorners { vec3 data[]; };

// Arrays by address: they may exceed maxStorageBufferRange.
layout(scalar) buffer HybridLeaves {
    LargeUints words;         // One per leaf (hybrid_types.h).
    LeafLists primitives;     // All lists.
    LargeUints gridBits;      // Occupancy of cells: wordsPerGrid words per grid, level by level from the finest.
    LargeUints gridRanks;     // Occupied cells before each word.
    LargeUints cells;         // shape.cellWords per occupied cell (grid_cell.glsl).
    TriangleCorners corners;  // Three positions for each triangle of the scene.
    HybridShape shape;
} hybridLeaves;

bool isEmptyLeaf(uint leaf) { return leaf == LEAF_EMPTY; }
bool isGridLeaf(uint leaf) { return leaf != LEAF_EMPTY && (leaf & LEAF_IS_GRID) != 0u; }
// First item of a leaf with a list.
uint firstItem(uint leaf) { return leaf & ~LIST_HAS_GROUPS; }

// One level of a grid.
struct GridLevel {
    uint edge;       // Cells along an edge.
    uint firstBit;   // Of the level, in the grid.
    uint firstWord;  // Of the grid.
};
GridLevel gridLevel(uint grid, uint level) {
    const uint m = hybridLeaves.shape.gridResolution;
    uint firstBit = 0u;
    for (uint finer = 0u; finer < level; ++finer) {
        const uint edge = GRID_EDGE(m, finer);
        firstBit += edge * edge * edge;
    }
    return GridLevel(GRID_EDGE(m, level), firstBit, grid * hybridLeaves.shape.wordsPerGrid);
}

// A cell's occupancy bit: x + edge (y + edge z) in its level.
struct GridBit {
    uint word;
    uint bit;
};
GridBit gridBit(GridLevel level, ivec3 cell) {
    const uint bitIndex = level.firstBit + uint(cell.x) + level.edge * (uint(cell.y) + level.edge * uint(cell.z));
    return GridBit(level.firstWord + (bitIndex >> 5), 1u << (bitIndex & 31u));
}

// Index of an occupied cell among those of all grids; NO_CELL for an empty one.
#define NO_CELL 0xffffffffu
uint gridCellIndex(LargeUints gridBits, LargeUints gridRanks, GridBit cellBit) {
    const uint bits = gridBits.data[cellBit.word];
    if ((bits & cellBit.bit) == 0u) return NO_CELL;
    return gridRanks.data[cellBit.word] + uint(bitCount(bits & (cellBit.bit - 1u)));
}
uint gridCellIndex(GridBit cellBit) { return gridCellIndex(hybridLeaves.gridBits, hybridLeaves.gridRanks, cellBit); }

#endif
