// A node of an octree of bricks, shared by C++ (passes/common/octree/brick_octree.h) and GLSL
// (shaders/octree/brick_octree.glsl).
#ifndef VOXRAY_SHARED_BRICK_OCTREE_TYPES_H
#define VOXRAY_SHARED_BRICK_OCTREE_TYPES_H

#include "shaders/shared/types.h"

#define NO_CHILDREN 0u  // Number 0 is the root: nobody's child or neighbour.
#define NO_NEIGHBOR 0u
#define NO_BRICK 0xffffffffu
#define BRICK_VALUES 27u
#define STATIC_LEAF 0x40000000u  // A bit of `cell`: a leaf that surfaces pass through which stay.

VOXRAY_SHARED_BEGIN

// Arnebäck 2017, listing 2, in its order: 11 words.
struct BrickNode {
    uint firstChild;  // Of eight, octants x + 2 y + 4 z.
    uint brick;
    uint neighbor[6];  // Of the same level: +x +y +z -x -y -z.
    uint color;        // Of a leaf: mean of its fragments as RGBA8, their number in alpha; 0 without any, ...
    uint normal;       // ... likewise. Both are 0 where materials are kept by surface voxel.
    uint cell;         // Its place on its level, 10 bits an axis; the thesis has its center.
};

// The nodes of a level: in the static section of the node pool, and in the dynamic one, which stands behind
// all of it.
struct LevelNodes {
    uint staticFirst;
    uint staticCount;
    uint dynamicFirst;
    uint dynamicCount;
};

VOXRAY_SHARED_END

#endif
