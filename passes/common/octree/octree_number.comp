// Assigns indices to the children of a level's nodes, in the order of the masks' bits. Writes the nodes' words, also to
// the table, and the coordinates of the children.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/octree.glsl"
layout(local_size_x = 64) in;

readonly buffer Cells { uint data[]; } cells;
readonly buffer Masks { uint words[]; } masks;
readonly buffer Before { uint bits[]; } before;
writeonly buffer ChildCells { uint data[]; } childCells;
layout(push_constant) uniform Push {
    uint level;
    uint count;
    uint firstNode;
    uint firstChild;
} push;

void main() {
    const uint word = linearIndex();
    uint child = 4u * word < push.count ? before.bits[word] : 0u;
    for (uint i = 4u * word; i < min(4u * word + 4u, push.count); ++i) {
        const uint mask = masks.words[word] >> (8u * (i & 3u)) & 0xffu;
        const uint node = mask | (push.firstChild + child) << 8;
        const ivec3 cell = unpackCell(cells.data[i]);
        octree.nodes.data[push.firstNode + i] = node;
        if (push.level >= octree.shape.tableLevel)
            octree.table.data[octreeTableEntry(cell, push.level)] = node;
        for (uint bits = mask; bits != 0u; bits &= bits - 1u)
            childCells.data[child++] = packCell(2 * cell + octantOffset(findLSB(bits)));
    }
}
