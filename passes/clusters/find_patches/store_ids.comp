// Stores the ids of surfels: what is kept of them.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SurfelIdsRef { LargeUints surfelIds; };
layout(push_constant) uniform Push { uint surfels; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.surfels) surfelIds.data[i] = groupedSurfels.data[i].id;
}
