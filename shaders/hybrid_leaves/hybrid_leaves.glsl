// Access to the leaves of a hybrid octree (Seok 2021, section 3.1; docs/hybrid-leaves.md): each surface voxel is a leaf with a list of
// the triangles in it, or with a grid of finer voxels, its cells, where triangles are many. Leaves are numbered as surface voxels are
// (voxelNumber() of shaders/voxels/voxels.glsl).
#ifndef VOXRAY_HYBRID_LEAVES_GLSL
#define VOXRAY_HYBRID_LEAVES_GLSL

#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require

#include "shaders/compute/large_buffer.glsl"
#include "shaders/hybrid_leaves/hybrid_types.h"

// The arrays stand behind addresses, since they outgrow what devices bind.
layout(scalar) buffer HybridLeaves {
    LargeUints words;       // One a leaf.
    LargeUints primitives;  // Lists, one after the other, each in ascending order.
    HybridShape shape;
} hybridLeaves;

bool isEmptyLeaf(uint leaf) { return leaf == LEAF_EMPTY; }
bool isGridLeaf(uint leaf) { return leaf != LEAF_EMPTY && (leaf & LEAF_IS_GRID) != 0u; }

#endif
