// Marks and counts the uniform nodes of a level. All eight children of a uniform node exist, are uniform or leaves, and
// have the same values as the node in each direction, so that it can replace them.
#include "shaders/compute/linear_index.glsl"
#include "passes/cones/radiance/radiance_svo.glsl"
layout(local_size_x = 64) in;

buffer Uniform { uint bits[]; } uniform_;
buffer Counts { uint nodes[]; } counts;
layout(push_constant) uniform Push {
    uint level;
    uint count;
    uint firstNode;
} push;

bool isUniformNode(uint node) {
    const uint word = octree.nodes.data[node];
    if (octreeMask(word) != 0xffu) return false;
    for (uint octant = 0u; octant < 8u; ++octant) {
        const uint child = octreeChild(word, octant);
        if (push.level > 1u && (uniform_.bits[child / 32u] >> (child & 31u) & 1u) == 0u) return false;
        for (uint face = 0u; face < radianceVoxels.grid.directions; ++face) {
            if (radianceVoxels.values.data[octreeValueIndex(child, face)] !=
                radianceVoxels.values.data[octreeValueIndex(node, face)])
                return false;
        }
    }
    return true;
}

void main() {
    if (linearIndex() >= push.count) return;
    const uint node = push.firstNode + linearIndex();
    if (!isUniformNode(node)) return;
    atomicOr(uniform_.bits[node / 32u], 1u << (node & 31u));
    atomicAdd(counts.nodes[push.level], 1u);
}
