// Mean inverse distance of what each surfel sees, over its cosine-distributed rays. KEEPS_HITS: the sum instead, by surfel
// and in fixed point, which changes with each link that is traced again (link_hits.comp).
#include "passes/radiosity/link_surfels/link_hit.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

#ifdef KEEPS_HITS
layout(scalar) readonly buffer LinkHitsRef { LargeUints linkHits; };
layout(scalar) readonly buffer InverseSumsRef { LargeUints inverseSums; };  // By surfel.
#else
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer SortedIndicesRef { LargeUints sortedIndices; };
layout(scalar) readonly buffer InverseDistancesRef { LargeFloats inverseDistances; };  // By sorted surfel, 1/voxel.
#endif
layout(push_constant) uniform Push {
    uint firstSurfel;  // Of the batch.
    uint batchSurfels;
    uint raysPerSurfel;
#ifndef KEEPS_HITS
    float voxelSize;  // m
#endif
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.batchSurfels) return;
#ifdef KEEPS_HITS
    const float units = inverseDistanceUnits(push.raysPerSurfel);
    uint sum = 0u;
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray)
        sum += linkInverseDistance(linkHits.data[linkHitIndex(push.firstSurfel + i, ray, push.raysPerSurfel)], units);
    inverseSums.data[push.firstSurfel + i] = sum;
#else
    const uint sortedIndex = sortedIndices.data[push.firstSurfel + i];
    if (sortedIndex == 0xffffffffu) return;
    float sum = 0.0;
    for (uint ray = 0u; ray < push.raysPerSurfel; ++ray) {
        const Hit hit = hits.data[i * push.raysPerSurfel + ray];
        if (hit.triangle != NO_HIT) sum += 1.0 / max(hit.t / push.voxelSize, MIN_LINK_DISTANCE);
    }
    inverseDistances.data[sortedIndex] = sum / float(push.raysPerSurfel);
#endif
}
