// How near the surfaces are that each surfel sees: the mean of 1 / distance over its rays, cosine distributed.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer SlotsAt { LargeUints slots; };
layout(scalar) readonly buffer InverseDistancesAt { LargeFloats inverseDistances; };  // By slot, 1 / voxel.
layout(push_constant) uniform Push {
    uint firstNumber;  // Of the first ray's surfel.
    uint surfelCount;  // Of this batch.
    uint raysPerSurfel;
    float voxelSize;  // m
} push;

// Voxels. What is nearer counts as that near: in a corner a single ray would decide alone. Chosen.
const float MIN_DISTANCE = 1.0 / 64.0;

void main() {
    const uint i = linearIndex();
    if (i >= push.surfelCount) return;
    const uint slot = slots.data[push.firstNumber + i];
    if (slot == 0xffffffffu) return;
    float sum = 0.0;
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray) {
        const Hit hit = hits.data[i * push.raysPerSurfel + ray];
        if (hit.triangle != NO_HIT) sum += push.voxelSize / max(hit.t, MIN_DISTANCE * push.voxelSize);
    }
    inverseDistances.data[slot] = sum / float(push.raysPerSurfel);
}
