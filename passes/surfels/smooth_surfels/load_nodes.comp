// Takes the nodes' values from the irradiance of surfels. BY_SURFEL: nodes are the surfels of Surfels, else sorted ones.
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/smooth_surfels/smooth_nodes.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

#ifdef BY_SURFEL
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
#endif
layout(scalar) readonly buffer LitRef { LitSurfels lit; };
layout(scalar) readonly buffer NodesRef { SmoothNodes nodes; };
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint node = linearIndex();
    if (node >= push.count) return;
#ifdef BY_SURFEL
    const uint surfel = sortedIndices.data[node];
    if (surfel == 0xffffffffu) {
        nodes.data[node] = uvec2(0u);
        return;
    }
#else
    const uint surfel = node;
#endif
    const LitSurfel s = unpackLit(lit.data[surfel]);
    nodes.data[node] = uvec2(floatBitsToUint(s.inverseDistance), s.radiosity);
}
