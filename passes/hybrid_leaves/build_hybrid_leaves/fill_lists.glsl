// Fragment callback: adds a triangle to its leaf's list, from the last item to the first; or, where the leaf has a
// grid, the pair of both to those that are voxelized further.
#ifndef VOXRAY_FILL_LISTS_GLSL
#define VOXRAY_FILL_LISTS_GLSL

#include "passes/hybrid_leaves/build_hybrid_leaves/is_listed.glsl"
#include "passes/hybrid_leaves/build_hybrid_leaves/triangle_leaf_box.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/octree/octree_cells.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Remaining { uint items[]; } remaining;  // Free items of each list; 0 for unchanged leaves.
buffer PairCount { uint count; } pairCount;
layout(scalar) readonly buffer PairsRef { LargeUints leafPairs; };  // Triangle, voxel by packCell(), grid.

void processFragment(TriangleFragment f) {
    const uint leaf = voxelNumber(voxelizer.grid, f.voxel);
    if (leaf == NO_VOXEL || !isListed(f) || remaining.items[leaf] == 0u) return;
    const uint word = hybridLeaves.words.data[leaf];
    if (isGridLeaf(word)) {
        const uint pairWord = 3u * atomicAdd(pairCount.count, 1u);
        leafPairs.data[pairWord] = f.triangle;
        leafPairs.data[pairWord + 1u] = packCell(f.voxel);
        leafPairs.data[pairWord + 2u] = word & ~LEAF_IS_GRID;
    } else {
        hybridLeaves.primitives.data[firstItem(word) + atomicAdd(remaining.items[leaf], ~0u) - 1u] =
            ListItem(triangleLeafBox(f), f.triangle);
    }
}

#endif
