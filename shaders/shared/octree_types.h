// The shape of a sparse voxel octree, shared by C++ (passes/filter_voxels/octree.h) and GLSL (shaders/octree.glsl).
#ifndef VOXRAY_SHARED_OCTREE_TYPES_H
#define VOXRAY_SHARED_OCTREE_TYPES_H

#include "shaders/shared/types.h"

#define OCTREE_MOST_LEVELS 11u  // 1024 voxels along a side: levels 0 to 10.
#define NO_NODE 0xffffffffu

VOXRAY_SHARED_BEGIN

// Level 0 has the finest voxels, a node of level l is a cube of 2^l of them along each side, the root is the one node of
// level `levels`. Node (x, y, z) of level l spans origin + voxelSize * 2^l * [x, x+1] and so on.
struct OctreeShape {
    vec3 origin;      // m
    float voxelSize;  // m
    uvec3 resolution;  // Voxels of the grid that the root encloses.
    uint levels;
    uint tableLevel;  // From this level on up, nodes are found by a table.
    uint nodeCount;   // Of all levels, padding included: the stride from one direction's values to the next.
    uint directions;  // 1 or 6 values a node.
    uint tableFirst[OCTREE_MOST_LEVELS];  // Where the table of level tableLevel + i begins.
};

VOXRAY_SHARED_END

#endif
