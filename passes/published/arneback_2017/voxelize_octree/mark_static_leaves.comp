// Marks the leaves of the static section that have fragments.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/brick_octree.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer OctreeNodesRef { BrickNodes nodes; };
layout(push_constant) uniform Push {
    uint firstNode;
    uint count;
} push;

void main() {
    if (linearIndex() >= push.count) return;
    const uint leaf = push.firstNode + linearIndex();
    if (nodes.data[leaf].color != 0u) nodes.data[leaf].cell |= STATIC_LEAF;
}
