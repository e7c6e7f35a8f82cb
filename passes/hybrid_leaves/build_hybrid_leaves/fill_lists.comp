// A walk's visitor: adds a triangle to the list of its leaf, from the last place to the first; or the pair of both to those that are
// voxelized further, where the leaf has a grid.
#include "passes/hybrid_leaves/build_hybrid_leaves/listed.glsl"
#include "passes/hybrid_leaves/build_hybrid_leaves/box_in_leaf.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/octree/octree_cells.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Left { uint places[]; } left;  // In each leaf's list; 0 of leaves that are kept.
buffer PairCount { uint count; } pairCount;
layout(scalar) readonly buffer PairsAt { LargeUints leafPairs; };  // Triangle, voxel by packCell(), and grid of each.

void visitFragment(TriangleFragment f) {
    const uint leaf = voxelNumber(walk.grid, f.voxel);
    if (leaf == NO_VOXEL || !isListed(f) || left.places[leaf] == 0u) return;
    const uint word = hybridLeaves.words.data[leaf];
    if (isGridLeaf(word)) {
        const uint at = 3u * atomicAdd(pairCount.count, 1u);
        leafPairs.data[at] = f.triangle;
        leafPairs.data[at + 1u] = packCell(f.voxel);
        leafPairs.data[at + 2u] = word & ~LEAF_IS_GRID;
    } else {
        hybridLeaves.primitives.data[firstItem(word) + atomicAdd(left.places[leaf], ~0u) - 1u] = ListItem(boxInLeaf(f), f.triangle);
    }
}
