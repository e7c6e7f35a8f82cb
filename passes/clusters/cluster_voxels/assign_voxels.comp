// SLIC assignment: each seed bids for the voxels within reach (Cosin and Patow 2022, algorithm 1, lines 4 to 12). The least cost wins,
// then the lowest seed; as this is a total order, the order of threads doesn't matter. Costs:
// - nearest: clusterDistance(), within the angle limit only.
// - first: equation 1. It is 1 within the limit, though line 7 minimizes it; we read it as 0 within the limit and 1 beyond. Equal costs
//   are decided by a random order of seeds. So voxels that no seed within the limit reaches go to another one (section 4.2: a cluster
//   takes what it tests for the first time, whatever the angle).
#include "passes/clusters/cluster_voxels/neighbourhood.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Seeds { ClusterSeed data[]; } seeds;
layout(scalar) buffer BestSeed { uint64_t data[]; } bestSeed;  // By voxel: cost << 32 | seed.

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ClusterSeed seed = seeds.data[i];
    if (seed.memberCount == 0u) return;
    ivec3 first, last;
    boxWithinReach(seed.center, first, last);
    for (BoxIterator it = voxelsInBox(first, last); nextVoxel(it);) {
        const float cosine = dot(seed.normal, normals.data[it.number]);
        const bool isWithinLimit = cosine >= push.minCosine;
        if (push.takesFirst == 0u && !isWithinLimit) continue;
        const uint cost = push.takesFirst == 1u ? (hash(i) >> 1) | (isWithinLimit ? 0u : 0x80000000u)
                                                : floatBitsToUint(max(clusterDistance(seed.center, it.voxel, cosine), 0.0));
        atomicMin(bestSeed.data[it.number], (uint64_t(cost) << 32) | uint64_t(i));
    }
}
