// Pass "Find Neighbors" (Arnebäck 2017, section 3.2.2): the six neighbours of each node of a level, by descent.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uint belowRoot;  // Levels.
} push;

void main() {
    if (linearIndex() >= nodesOf(push.nodes)) return;
    const uint node = levelNode(push.nodes, linearIndex());
    const ivec3 cell = unpackCell(nodes.data[node].cell);
    const int cells = 1 << push.belowRoot;
    for (uint side = 0u; side < 6u; ++side) {
        ivec3 at = cell;
        at[side % 3u] += side < 3u ? 1 : -1;
        const bool isInside = all(greaterThanEqual(at, ivec3(0))) && all(lessThan(at, ivec3(cells)));
        const uint found = isInside ? findNode(nodes, at, push.belowRoot) : NO_BRICK_NODE;
        nodes.data[node].neighbor[side] = found == NO_BRICK_NODE ? NO_NEIGHBOR : found;
    }
}
