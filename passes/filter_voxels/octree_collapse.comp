#version 460
#extension GL_GOOGLE_include_directive : require
// Moves a level of an octree (binding radianceVoxels) into a smaller one without what lies below uniform nodes: the masks of
// the level's nodes (MASKS), then the numbers and values of their children (CHILDREN). A thread takes four nodes of the new
// octree; `nodes` tells for each its number in the old one and its cell.
#include "passes/filter_voxels/octree_cells.glsl"
#include "shaders/linear_index.glsl"
#include "shaders/octree.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) readonly buffer Nodes { uvec2 data[]; } nodes;
layout(set = 0, binding = 1) readonly buffer Uniform { uint bits[]; } uniform_;
layout(set = 0, binding = 2) buffer Masks { uint words[]; } masks;
#ifdef CHILDREN
layout(set = 0, binding = 3) readonly buffer Before { uint bits[]; } before;
layout(set = 0, binding = 4) writeonly buffer Children { uvec2 data[]; } children;
layout(set = 0, binding = 5, scalar) readonly buffer Collapsed {
    RadianceGrid grid;
    OctreeTable table;
    OctreeNodes nodes;
    OctreeValues values;
    OctreeShape octree;
} collapsed;
#endif
layout(push_constant) uniform Push {
    uint count;  // Nodes of the level that stay.
    uint firstNode;
    uint firstChild;
    uint childLevel;
} push;

void main() {
    const uint word = linearIndex();
    if (4u * word >= push.count) return;
#ifdef MASKS
    uint mask = 0u;
    for (uint i = 0u; i < min(4u, push.count - 4u * word); ++i) {
        const uint old = nodes.data[4u * word + i].x;
        const bool uniformNode = (uniform_.bits[old / 32u] >> (old & 31u) & 1u) != 0u;
        if (!uniformNode) mask |= octreeChildren(old) << (8u * i);
    }
    masks.words[word] = mask;
#else
    const uint mask = masks.words[word];
    uint child = before.bits[word];
    collapsed.nodes.four[push.firstNode / 4u + word] = uvec2(mask, push.firstChild + child);
    for (uint bits = mask; bits != 0u; bits &= bits - 1u, ++child) {
        const uint bit = findLSB(bits);
        const uvec2 parent = nodes.data[4u * word + bit / 8u];
        const uint old = octreeChild(parent.x, bit & 7u), new = push.firstChild + child;
        const uvec3 cell = 2u * unpackCell(parent.y) + (uvec3(bit, bit >> 1, bit >> 2) & 1u);
        children.data[child] = uvec2(old, packCell(cell));
        for (uint face = 0u; face < collapsed.grid.directions; ++face)
            collapsed.values.data[face * collapsed.octree.nodeCount + new] =
                radianceVoxels.values.data[face * radianceVoxels.octree.nodeCount + old];
        if (push.childLevel < collapsed.octree.tableLevel) continue;
        const uvec3 size = octreeCells(push.childLevel);
        collapsed.table.node[collapsed.octree.tableFirst[push.childLevel - collapsed.octree.tableLevel] +
                             (cell.z * size.y + cell.y) * size.x + cell.x] = new;
    }
#endif
}
