// The shape of a sparse voxel octree, shared by C++ (passes/common/octree/octree.h) and GLSL
// (shaders/octree/octree.glsl).
#ifndef VOXRAY_SHARED_OCTREE_TYPES_H
#define VOXRAY_SHARED_OCTREE_TYPES_H

#include "shaders/shared/types.h"

#define OCTREE_MAX_LEVELS 11u       // 1024 voxels along an axis.
#define OCTREE_MAX_NODES 0xffffffu  // Numbers have 24 bits.
#define NO_NODE 0u

VOXRAY_SHARED_BEGIN

// A node is a voxel of a level that is not empty. Level 0 has the voxels of the grid, its nodes are the
// leaves; the root is the one node of the last level.
struct OctreeShape {
    uvec3 resolution;  // Voxels of the grid.
    uint levels;
    uint nodeCount;                           // Of all levels and NO_NODE: one more than the largest number.
    uint firstLeaf;                           // Number of the first leaf; leaves come last.
    uint tableLevel;                          // From this level on up, nodes are found by a table.
    uint tableFirst[OCTREE_MAX_LEVELS + 1u];  // Where the table of level tableLevel + i begins.
};

VOXRAY_SHARED_END

#endif
