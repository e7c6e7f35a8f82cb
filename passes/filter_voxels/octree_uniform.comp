#version 460
#extension GL_GOOGLE_include_directive : require
// Marks and counts the uniform nodes of a level: all eight children are there, are uniform or leaves, and hold the same bits as
// the node in each direction, so that it can stand for them. A thread takes a node.
#include "shaders/linear_index.glsl"
#include "shaders/octree.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) buffer Uniform { uint bits[]; } uniform_;
layout(set = 0, binding = 1) buffer Counts { uint nodes[]; } counts;
layout(push_constant) uniform Push {
    uint firstNode;
    uint count;
    uint level;
} push;

bool isUniform(uint node) {
    if (octreeChildren(node) != 0xffu) return false;
    const uint first = octreeChild(node, 0u);
    for (uint child = first; child < first + 8u; ++child) {
        if (push.level > 1u && (uniform_.bits[child / 32u] >> (child & 31u) & 1u) == 0u) return false;
        for (uint face = 0u; face < radianceVoxels.grid.directions; ++face) {
            const uint values = face * radianceVoxels.octree.nodeCount;
            if (radianceVoxels.values.data[values + child] != radianceVoxels.values.data[values + node]) return false;
        }
    }
    return true;
}

void main() {
    if (linearIndex() >= push.count) return;
    const uint node = push.firstNode + linearIndex();
    if (!isUniform(node)) return;
    atomicOr(uniform_.bits[node / 32u], 1u << (node & 31u));
    atomicAdd(counts.nodes[push.level], 1u);
}
