#version 460
#extension GL_GOOGLE_include_directive : require
// Numbers the children of a level's nodes: they follow each other in the order of the masks' bits. Writes the level's entries,
// the cells of the children and, from the table's level on up, where the children are found. A thread takes four nodes.
#include "passes/filter_voxels/octree_cells.glsl"
#include "shaders/linear_index.glsl"
#include "shaders/octree.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) readonly buffer Cells { uint data[]; } cells;
layout(set = 0, binding = 1) readonly buffer Masks { uint words[]; } masks;
layout(set = 0, binding = 2) readonly buffer Before { uint bits[]; } before;
layout(set = 0, binding = 3) writeonly buffer ChildCells { uint data[]; } childCells;
layout(push_constant, scalar) uniform Push {
    uint count;  // Nodes of the level.
    uint firstNode;
    uint firstChild;
    uint childLevel;
} push;

void main() {
    const uint word = linearIndex();
    if (4u * word >= push.count) return;
    const uint mask = masks.words[word];
    uint child = before.bits[word];
    radianceVoxels.nodes.four[push.firstNode / 4u + word] = uvec2(mask, push.firstChild + child);
    for (uint bits = mask; bits != 0u; bits &= bits - 1u, ++child) {
        const uint bit = findLSB(bits);
        const uvec3 cell = 2u * unpackCell(cells.data[4u * word + bit / 8u]) + (uvec3(bit, bit >> 1, bit >> 2) & 1u);
        childCells.data[child] = packCell(cell);
        if (push.childLevel >= radianceVoxels.octree.tableLevel)
            radianceVoxels.table.node[octreeTableEntry(cell, push.childLevel)] = push.firstChild + child;
    }
}
