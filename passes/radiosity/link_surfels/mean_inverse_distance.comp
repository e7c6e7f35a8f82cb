// Mean inverse distance of what each surfel sees, over its cosine-distributed rays.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
layout(scalar) readonly buffer InverseDistancesRef { LargeFloats inverseDistances; };  // By sorted surfel, 1/voxel.
layout(push_constant) uniform Push {
    uint firstSurfel;  // Of the batch.
    uint surfelCount;  // Of the batch.
    uint raysPerSurfel;
    float voxelSize;  // m
} push;

// In voxels. Lower bound, since in a corner one ray would dominate the mean. Chosen.
const float MIN_DISTANCE = 1.0 / 64.0;

void main() {
    const uint i = linearIndex();
    if (i >= push.surfelCount) return;
    const uint sortedIndex = sortedIndices.data[push.firstSurfel + i];
    if (sortedIndex == 0xffffffffu) return;
    float sum = 0.0;
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray) {
        const Hit hit = hits.data[i * push.raysPerSurfel + ray];
        if (hit.triangle != NO_HIT) sum += push.voxelSize / max(hit.t, MIN_DISTANCE * push.voxelSize);
    }
    inverseDistances.data[sortedIndex] = sum / float(push.raysPerSurfel);
}
