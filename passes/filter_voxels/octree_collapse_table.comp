#version 460
#extension GL_GOOGLE_include_directive : require
// Cells of the table that lie in a uniform node lead to it: a level's entries that have nothing of their own take the next
// level's. A thread takes an entry.
#include "shaders/linear_index.glsl"
#include "shaders/octree.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push { uint level; } push;

void main() {
    const uvec3 size = octreeCells(push.level);
    const uint i = linearIndex();
    if (i >= size.x * size.y * size.z) return;
    const uvec3 cell = uvec3(i % size.x, i / size.x % size.y, i / size.x / size.y);
    const uint entry = octreeTableEntry(cell, push.level);
    if (radianceVoxels.table.node[entry] != NO_NODE) return;
    const uint parent = radianceVoxels.table.node[octreeTableEntry(cell / 2u, push.level + 1u)];
    if (parent == NO_NODE) return;
    // Inner cells of the table always lead to a node of their own level: only below a uniform one there is a mask of 0.
    if (octreeChildren(parent) == 0u) radianceVoxels.table.node[entry] = parent;
}
