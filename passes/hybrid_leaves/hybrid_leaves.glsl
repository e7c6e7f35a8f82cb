// Access to the leaves of a hybrid octree (Seok 2021, section 3.1; docs/hybrid-leaves.md): each surface voxel is a leaf with a list of
// the triangles in it, or with a grid of finer voxels, its cells, where triangles are many. Leaves are numbered as surface voxels are
// (voxelNumber() of shaders/voxels/voxels.glsl).
#ifndef VOXRAY_HYBRID_LEAVES_GLSL
#define VOXRAY_HYBRID_LEAVES_GLSL


#include "shaders/compute/large_buffer.glsl"
#include "passes/hybrid_leaves/hybrid_types.h"

struct ListItem {
    uint box;  // And LIST_ENDS.
    uint triangle;
};
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LeafLists { ListItem data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TriangleCorners { vec3 data[]; };

// The arrays stand behind addresses, since they outgrow what devices bind.
layout(scalar) buffer HybridLeaves {
    LargeUints words;       // One a leaf.
    LeafLists primitives;   // Lists, one after the other.
    LargeUints gridBits;    // Which cells of each grid are not empty: wordsPerGrid words a grid, level by level, the finest first.
    LargeUints gridRanks;   // Such cells before each word.
    LargeUints cells;       // shape.cellWords each (passes/hybrid_leaves/grid_cell.glsl).
    TriangleCorners corners;  // Three positions for each of the scene's triangles, in one place for a test.
    HybridShape shape;
} hybridLeaves;

bool isEmptyLeaf(uint leaf) { return leaf == LEAF_EMPTY; }
bool isGridLeaf(uint leaf) { return leaf != LEAF_EMPTY && (leaf & LEAF_IS_GRID) != 0u; }
// Of a leaf with a list: the number of its first item.
uint firstItem(uint leaf) { return leaf & ~LIST_HAS_GROUPS; }

// The cells of one level of a grid.
struct GridLevel {
    uint edge;       // Cells along an edge.
    uint firstBit;   // Among the grid's.
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

// A cell by its bit: bit x + edge (y + edge z) of its level.
struct GridBit {
    uint word;
    uint bit;
};
GridBit gridBit(GridLevel level, ivec3 cell) {
    const uint at = level.firstBit + uint(cell.x) + level.edge * (uint(cell.y) + level.edge * uint(cell.z));
    return GridBit(level.firstWord + (at >> 5), 1u << (at & 31u));
}

// Its number among the cells of all grids that are not empty; NO_CELL where it is.
#define NO_CELL 0xffffffffu
uint gridCellNumber(LargeUints gridBits, LargeUints gridRanks, GridBit at) {
    const uint bits = gridBits.data[at.word];
    if ((bits & at.bit) == 0u) return NO_CELL;
    return gridRanks.data[at.word] + uint(bitCount(bits & (at.bit - 1u)));
}
uint gridCellNumber(GridBit at) { return gridCellNumber(hybridLeaves.gridBits, hybridLeaves.gridRanks, at); }

#endif
