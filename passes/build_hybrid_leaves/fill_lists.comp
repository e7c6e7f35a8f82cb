#version 460
#extension GL_GOOGLE_include_directive : require
// A walk's visitor: adds a triangle to the list of its leaf, from the last place to the first.
#include "passes/common/triangle_walk/exact.glsl"
#include "shaders/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Sizes { uint words[]; } sizes;  // Places left in each leaf's list.

void visitFragment(TriangleFragment f) {
    const uint leaf = voxelNumber(walk.grid, f.voxel);
    if (leaf == NO_VOXEL) return;
    const uint word = hybridLeaves.words.data[leaf];
    if (isEmptyLeaf(word) || isGridLeaf(word)) return;
    hybridLeaves.primitives.data[word + atomicAdd(sizes.words[leaf], ~0u) - 1u] = f.triangle;
}
