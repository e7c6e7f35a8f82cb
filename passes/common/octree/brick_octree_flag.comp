// Pass "Flag Nodes" (Arnebäck 2017, section 3.2.2): flags the nodes of a level that hold fragments, and their 26
// neighbors, if they have no brick yet. The first fragment of a node does so for all.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer FragmentCellsRef { LargeUints cells; };
layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
buffer Visited { uint data[]; } visited;  // By node of the level: 1 after its first fragment.
buffer Flags { uint data[]; } flags;      // By node of the level: 1 if it gets a brick.
layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uvec3 resolution;  // Of the level.
    uint level;        // 0: leaves.
    uint depth;        // Of the level; the root's is 0.
    uint fragments;
    uint neighbors;  // 1: flags the 26 neighbors.
} push;

void flagNode(ivec3 cell) {
    const uint node = findNode(nodes, cell, push.depth);
    if (node == NO_BRICK_NODE || nodes.data[node].brick != NO_BRICK) return;
    flags.data[indexInLevel(push.nodes, node)] = 1u;
}

void main() {
    if (linearIndex() >= push.fragments) return;
    const ivec3 cell = unpackCell(cells.data[linearIndex()]) >> push.level;
    const uint node = findNode(nodes, cell, push.depth);
    if (node == NO_BRICK_NODE) return;
    const uint index = indexInLevel(push.nodes, node);
    if (visited.data[index] != 0u || atomicExchange(visited.data[index], 1u) != 0u) return;
    const int radius = int(push.neighbors);
    const ivec3 low = max(cell - radius, ivec3(0)), high = min(cell + radius, ivec3(push.resolution) - 1);
    for (int z = low.z; z <= high.z; ++z)
        for (int y = low.y; y <= high.y; ++y)
            for (int x = low.x; x <= high.x; ++x) flagNode(ivec3(x, y, z));
}
