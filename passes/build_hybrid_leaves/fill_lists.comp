#version 460
#extension GL_GOOGLE_include_directive : require
// A walk's visitor: adds a triangle to the list of its leaf, from the last place to the first, or flags it where the leaf has a grid.
#include "passes/build_hybrid_leaves/listed.glsl"
#include "shaders/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Left { uint places[]; } left;         // In each leaf's list.
buffer Touching { uint words[]; } touching;  // A bit for each triangle.

void visitFragment(TriangleFragment f) {
    const uint leaf = voxelNumber(walk.grid, f.voxel);
    if (leaf == NO_VOXEL || !isListed(f)) return;
    const uint word = hybridLeaves.words.data[leaf];
    if (isGridLeaf(word))
        atomicOr(touching.words[f.triangle >> 5], 1u << (f.triangle & 31u));
    else
        hybridLeaves.primitives.data[word + atomicAdd(left.places[leaf], ~0u) - 1u] = f.triangle;
}
