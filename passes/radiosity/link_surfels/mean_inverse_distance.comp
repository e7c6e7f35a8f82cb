// Mean inverse distance of what each surfel sees, over its cosine-distributed rays.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

#ifdef KEEPS_HITS
layout(scalar) readonly buffer HitDistancesRef { LargeFloats hitDistances; };  // m; 1e30: none
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

// m; 1e30 without a hit.
float hitDistance(uint inBatch, uint ray) {
#ifdef KEEPS_HITS
    return hitDistances.data[ray * push.surfelCount + push.firstSurfel + inBatch];
#else
    const Hit hit = hits.data[inBatch * push.raysPerSurfel + ray];
    return hit.triangle != NO_HIT ? hit.t : 1.0e30;
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
        if (distance_ < 1.0e30) sum += push.voxelSize / max(distance_, MIN_DISTANCE * push.voxelSize);
    }
    inverseDistances.data[sortedIndex] = sum / float(push.raysPerSurfel);
}
