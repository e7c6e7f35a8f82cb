#version 460
#extension GL_GOOGLE_include_directive : require
// The values of a level's nodes from their children's. A thread takes a node.
#include "shaders/linear_index.glsl"
#include "shaders/octree.glsl"
#include "shaders/radiance_filter.glsl"
#include "shaders/radiance_texel.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint firstNode;
    uint count;
} push;

void main() {
    if (linearIndex() >= push.count) return;
    const uint node = push.firstNode + linearIndex();
    for (uint face = 0u; face < radianceOctree.shape.directions; ++face) {
        const uint first = face * radianceOctree.shape.nodeCount;
        vec4 child[8];
        for (uint octant = 0u; octant < 8u; ++octant) {
            const uint number = octreeChild(node, octant);
            child[octant] = number == NO_NODE ? vec4(0.0) : unpackRadiance(radianceOctree.values.data[first + number]);
        }
        const vec4 value = radianceOctree.shape.directions == 1u ? filterIsotropic(child) : filterDirection(child, face);
        radianceOctree.values.data[first + node] = packRadiance(value);
    }
}
