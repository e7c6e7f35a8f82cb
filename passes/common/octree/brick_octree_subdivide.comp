// Pass "Subdivision" (Arnebäck 2017, section 3.2.2): allocates a brick for each flagged node and, above the leaves,
// eight children. Indices come from a prefix sum over the flags, in place of the thesis's atomic counters, so that the
// pool is deterministic.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
readonly buffer Flags { uint data[]; } flags;
readonly buffer Before { uint data[]; } before;
layout(push_constant, scalar) uniform Push {
    LevelNodes nodes;
    uint firstBrick;
    uint firstChild;  // NO_CHILDREN for leaves.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= nodesOf(push.nodes) || flags.data[i] == 0u) return;
    const uint node = levelNode(push.nodes, i);
    nodes.data[node].brick = push.firstBrick + before.data[i];
    if (push.firstChild == NO_CHILDREN) return;
    const uint first = push.firstChild + 8u * before.data[i];
    nodes.data[node].firstChild = first;
    const ivec3 cell = unpackCell(nodes.data[node].cell);
    for (uint octant = 0u; octant < 8u; ++octant)
        nodes.data[first + octant] = BrickNode(NO_CHILDREN, NO_BRICK, uint[6](0u, 0u, 0u, 0u, 0u, 0u), 0u, 0u,
                                               packCell(2 * cell + octantOffset(octant)));
}
