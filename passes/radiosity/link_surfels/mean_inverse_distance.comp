// Mean inverse distance of what each surfel sees, over its cosine-distributed rays.
#include "passes/radiosity/link_surfels/link_hit.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

#ifdef KEEPS_HITS
layout(scalar) readonly buffer LinkHitsRef { LargeUints linkHits; };
#else
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
#endif
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
layout(scalar) readonly buffer InverseDistancesRef { LargeFloats inverseDistances; };  // By sorted surfel, 1/voxel.
layout(push_constant) uniform Push {
    uint firstSurfel;  // Of the batch.
    uint batchSurfels;
#ifdef KEEPS_HITS
    uint surfelCount;
#endif
    uint raysPerSurfel;
    float voxelSize;  // m
} push;

// In voxels. Lower bound, since in a corner one ray would dominate the mean. Chosen.
const float MIN_DISTANCE = 1.0 / 64.0;

// Voxels.
float hitDistance(uint inBatch, uint ray) {
#ifdef KEEPS_HITS
    return linkHitDistance(linkHits.data[ray * push.surfelCount + push.firstSurfel + inBatch]);
#else
    const Hit hit = hits.data[inBatch * push.raysPerSurfel + ray];
    return hit.triangle != NO_HIT ? hit.t / push.voxelSize : NO_LINK_HIT;
#endif
}

void main() {
    const uint i = linearIndex();
    if (i >= push.batchSurfels) return;
    const uint sortedIndex = sortedIndices.data[push.firstSurfel + i];
    if (sortedIndex == 0xffffffffu) return;
    float sum = 0.0;
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray) {
        const float distance_ = hitDistance(i, ray);
        if (distance_ < NO_LINK_HIT) sum += 1.0 / max(distance_, MIN_DISTANCE);
    }
    inverseDistances.data[sortedIndex] = sum / float(push.raysPerSurfel);
}
