// Gathers the corner positions of triangles for intersection tests.
#include "shaders/compute/linear_index.glsl"
#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/scene/scene.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint firstTriangle;
    uint count;
} push;

void main() {
    if (linearIndex() >= push.count) return;
    const uint triangle = push.firstTriangle + linearIndex();
    const uvec3 v = triangleVertices(triangle);
    for (uint k = 0u; k < 3u; ++k) hybridLeaves.corners.data[3u * triangle + k] = vertexPosition(v[k]);
}
