// Stores the nodes' irradiance as that of surfels. BY_SURFEL: nodes are the surfels of Surfels, else sorted ones.
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
layout(scalar) readonly buffer ResultRef { LitSurfels result; };
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint node = linearIndex();
    if (node >= push.count) return;
#ifdef BY_SURFEL
    const uint surfel = sortedIndices.data[node];
    if (surfel == 0xffffffffu) return;
#else
    const uint surfel = node;
#endif
    const u64vec2 words = lit.data[surfel];
    result.data[surfel] = u64vec2(packUint2x32(uvec2(unpackUint2x32(words.x).x, nodes.data[node].y)), words.y);
}
