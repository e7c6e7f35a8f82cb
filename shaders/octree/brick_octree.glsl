// The octree of bricks as published (Arnebäck 2017, section 3.1.1). A brick holds 3x3x3 values, 8 bits a channel, at
// its node's corners and at the centers of its edges, of its faces and of itself. So interpolation needs one brick
// only.
//
//        a --- b --- c --- d --- e       Two nodes. c, h and m are stored in both bricks, with the same values.
//        |     |     |     |     |
//        f --- g --- h --- i --- j
//        |     |     |     |     |
//        k --- l --- m --- n --- o
#ifndef VOXRAY_BRICK_OCTREE_GLSL
#define VOXRAY_BRICK_OCTREE_GLSL

#include "shaders/octree/brick_octree_types.h"
#include "shaders/octree/octree_cells.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer BrickNodes { BrickNode data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Bricks { uint data[]; };

// Index of a brick's value; `texel`: 0 to 2 along each axis.
uint brickIndex(uint brick, ivec3 texel) { return brick * BRICK_VALUES + uint((texel.z * 3 + texel.y) * 3 + texel.x); }

// From a node's index in its level to its index in the pool, and back.
uint levelNode(LevelNodes level, uint i) {
    return i < level.staticCount ? level.staticFirst + i : level.dynamicFirst + i - level.staticCount;
}
uint indexInLevel(LevelNodes level, uint node) {
    const uint i = node - level.staticFirst;
    return i < level.staticCount ? i : level.staticCount + node - level.dynamicFirst;
}
uint nodesOf(LevelNodes level) { return level.staticCount + level.dynamicCount; }

// The node at `depth` (root: 0) with the coordinates `cell` in its level, by descent; NO_BRICK_NODE where there is
// none.
#define NO_BRICK_NODE 0xffffffffu
uint findNode(BrickNodes nodes, ivec3 cell, uint depth) {
    uint node = 0u;
    for (uint remaining = depth; remaining > 0u; --remaining) {
        const uint first = nodes.data[node].firstChild;
        if (first == NO_CHILDREN) return NO_BRICK_NODE;
        node = first + octantOf(cell >> (remaining - 1u));
    }
    return node;
}

// The brick of that node; NO_BRICK where there is none.
uint findBrick(BrickNodes nodes, ivec3 cell, uint depth) {
    const uint node = findNode(nodes, cell, depth);
    return node == NO_BRICK_NODE ? NO_BRICK : nodes.data[node].brick;
}

#endif
