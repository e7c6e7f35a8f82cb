// The octree of bricks as published (Arnebäck 2017, section 3.1.1): bricks of 3x3x3 values of 8 bits a channel stand at a node's
// corners, the centers of its edges and faces, and its own, so that a brick alone can be interpolated in.
//
//        a --- b --- c --- d --- e       Two nodes. c, h and m stand in both bricks, and must be equal there.
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

// Where a value of a brick stands; `at`: 0 to 2 along each axis.
uint brickIndex(uint brick, ivec3 at) { return brick * BRICK_VALUES + uint((at.z * 3 + at.y) * 3 + at.x); }

// A node by its number among those of its level, and back.
uint levelNode(LevelNodes level, uint i) {
    return i < level.staticCount ? level.staticFirst + i : level.dynamicFirst + i - level.staticCount;
}
uint indexInLevel(LevelNodes level, uint node) {
    const uint i = node - level.staticFirst;
    return i < level.staticCount ? i : level.staticCount + node - level.dynamicFirst;
}
uint nodesOf(LevelNodes level) { return level.staticCount + level.dynamicCount; }

// The node `levels` below the root, by descent; NO_BRICK_NODE where there is none. `cell`: its place on its level.
#define NO_BRICK_NODE 0xffffffffu
uint findNode(BrickNodes nodes, ivec3 cell, uint levels) {
    uint node = 0u;
    for (uint below = levels; below > 0u; --below) {
        const uint first = nodes.data[node].firstChild;
        if (first == NO_CHILDREN) return NO_BRICK_NODE;
        node = first + octantOf(cell >> (below - 1u));
    }
    return node;
}

// The brick of that node; NO_BRICK where there is none.
uint findBrick(BrickNodes nodes, ivec3 cell, uint levels) {
    const uint node = findNode(nodes, cell, levels);
    return node == NO_BRICK_NODE ? NO_BRICK : nodes.data[node].brick;
}

#endif
