// Pass "Find Neighbors" (Arnebäck 2017, section 3.2.2): finds the six neighbors of each node of a level by descent.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uint depth;  // Of the level; the root's is 0.
} push;

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const uint node = levelNode(push.nodes, linearIndex());
    const ivec3 cell = unpackCell(nodes.data[node].cell);
    const int cells = 1 << push.depth;
    for (uint face = 0u; face < 6u; ++face) {
        ivec3 neighbor = cell;
        neighbor[face % 3u] += face < 3u ? 1 : -1;
        const bool isInside = all(greaterThanEqual(neighbor, ivec3(0))) && all(lessThan(neighbor, ivec3(cells)));
        const uint found = isInside ? findNode(nodes, neighbor, push.depth) : NO_BRICK_NODE;
        nodes.data[node].neighbor[face] = found == NO_BRICK_NODE ? NO_NEIGHBOR : found;
    }
}
