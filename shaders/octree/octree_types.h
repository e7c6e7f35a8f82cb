// The shape of a sparse voxel octree, shared by C++ (passes/common/octree/octree.h) and GLSL
// (shaders/octree/octree.glsl).
#ifndef VOXRAY_SHARED_OCTREE_TYPES_H
#define VOXRAY_SHARED_OCTREE_TYPES_H

#include "shaders/shared/types.h"

#define OCTREE_MAX_LEVELS 11u       // 1024 voxels along an axis.
#define OCTREE_MAX_NODES 0xffffffu  // Indices have 24 bits.
#define NO_NODE 0u

VOXRAY_SHARED_BEGIN

// A node is a nonempty voxel of a level. The leaves are the nodes of level 0, the voxels of the grid; the
// root is that of the last level.
struct OctreeShape {
    uvec3 resolution;  // Voxels of the grid.
    uint levels;
    uint nodeCount;                           // Of all levels, including NO_NODE. Leaves come last.
    uint tableLevel;                          // Finest level of the table.
    uint tableFirst[OCTREE_MAX_LEVELS + 1u];  // Index in the table of the first entry of level tableLevel + i.
};

VOXRAY_SHARED_END

#endif
