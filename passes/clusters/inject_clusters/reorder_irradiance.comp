// Copies the irradiance of a chunk's surfels into the order of VoxelPatches::surfels.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
layout(scalar) readonly buffer SurfelIndexRef { LargeUints surfelIndex; };
layout(scalar) readonly buffer SurfelIrradianceRef { SurfelValues surfelIrradiance; };
layout(push_constant) uniform Push {
    uint count;
    uint firstIndex;  // Index of the chunk's first surfel in the surfels of all chunks.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint index = surfelIndex.data[push.firstIndex + i];
    if (index != NO_GROUP) surfelIrradiance.data[index] = direct.data[i].rgb;
}
