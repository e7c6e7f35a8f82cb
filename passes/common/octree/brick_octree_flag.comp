// Pass "Flag Nodes" (Arnebäck 2017, section 3.2.2): flags the nodes of a level that fragments fall into and, where they have none yet,
// are to get a brick, and with them the 26 round each. The first fragment in a node does that for all of it.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer FragmentCellsRef { LargeUints cells; };
layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
buffer Visited { uint data[]; } visited;  // By node of the level: 1 once a fragment was there.
buffer Flags { uint data[]; } flags;      // Likewise: 1 for those that get a brick.
layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uvec3 resolution;  // Of the level.
    uint level;        // 0: leaves.
    uint belowRoot;    // Levels.
    uint fragments;
    uint neighbors;  // 1: with the 26 round each.
} push;

void flagNode(ivec3 cell) {
    const uint node = findNode(nodes, cell, push.belowRoot);
    if (node == NO_BRICK_NODE || nodes.data[node].brick != NO_BRICK) return;
    flags.data[indexInLevel(push.nodes, node)] = 1u;
}

void main() {
    if (linearIndex() >= push.fragments) return;
    const ivec3 cell = unpackCell(cells.data[linearIndex()]) >> push.level;
    const uint own = findNode(nodes, cell, push.belowRoot);
    if (own == NO_BRICK_NODE) return;
    const uint at = indexInLevel(push.nodes, own);
    if (visited.data[at] != 0u || atomicExchange(visited.data[at], 1u) != 0u) return;
    const int reach = int(push.neighbors);
    const ivec3 low = max(cell - reach, ivec3(0)), high = min(cell + reach, ivec3(push.resolution) - 1);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) flagNode(ivec3(x, y, z));
}
