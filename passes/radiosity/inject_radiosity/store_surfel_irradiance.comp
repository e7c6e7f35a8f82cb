// Stores the indirect irradiance of surfels in the order of SurfelsByVoxel, for gathers.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/packed_surfel.glsl"
#include "passes/surfels/radiosity.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Indirect { vec4 data[]; } indirect;  // W/m²
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
layout(scalar) readonly buffer PackedRef { PackedSurfels packed_; };
layout(scalar) readonly buffer LitRef { LitSurfels lit; };
layout(push_constant) uniform Push {
    uint count;
    uint firstSurfel;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint sortedIndex = sortedIndices.data[push.firstSurfel + i];
    if (sortedIndex == 0xffffffffu) return;
    lit.data[sortedIndex] = packLit(packed_.data[sortedIndex], packRadiosity(indirect.data[i].rgb));
}
