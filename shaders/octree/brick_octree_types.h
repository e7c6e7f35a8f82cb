// A node of an octree of bricks, shared by C++ (passes/common/octree/brick_octree.h) and GLSL
// (shaders/octree/brick_octree.glsl).
#ifndef VOXRAY_SHARED_BRICK_OCTREE_TYPES_H
#define VOXRAY_SHARED_BRICK_OCTREE_TYPES_H

#include "shaders/shared/types.h"

#define NO_CHILDREN 0u  // Index 0 is the root, which is no node's child or neighbor.
#define NO_NEIGHBOR 0u
#define NO_BRICK 0xffffffffu
#define BRICK_VALUES 27u
#define STATIC_LEAF 0x40000000u  // Bit of BrickNode::cell: a leaf that holds static surfaces.

VOXRAY_SHARED_BEGIN

// Arnebäck 2017, listing 2, in its order: 11 words.
struct BrickNode {
    uint firstChild;  // Index of the first of eight, in octant order x + 2 y + 4 z.
    uint brick;
    uint neighbor[6];  // In the same level: +x +y +z -x -y -z.
    uint color;        // Of a leaf: mean over its fragments as RGBA8, their number in alpha; 0 without fragments.
    uint normal;       // Likewise. Both are 0 where surface voxels hold the materials.
    uint cell;         // Coordinates in its level, 10 bits each; the thesis stores its center.
};

// The nodes of a level in the static section of the node pool, and in the dynamic section behind it.
struct LevelNodes {
    uint staticFirst;
    uint staticCount;
    uint dynamicFirst;
    uint dynamicCount;
};

VOXRAY_SHARED_END

#endif
