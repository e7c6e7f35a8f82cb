// Assigns voxels to seeds: each voxel gets the seed of least cost of those within reach (Cosin and Patow 2022,
// algorithm 1, lines 4 to 12). For equal costs it gets the lowest seed, so that the result does not depend on the order
// of threads.
// - nearest: the cost is clusterDistance(). Seeds beyond the angle limit are excluded.
// - first: the cost is equation 1. The paper has 1 within the angle limit, but line 7 minimizes it; we use 0 within the
//   limit and 1 beyond. Seeds of equal cost have a random order. A voxel without a seed within the limit gets one
//   beyond it (section 4.2: a cluster always adds a voxel that is tested for the first time, whatever the angle).
#include "passes/clusters/cluster_voxels/neighborhood.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Seeds { ClusterSeed data[]; } seeds;
layout(scalar) buffer BestSeed { uint64_t data[]; } bestSeed;  // Per voxel: cost << 32 | seed.

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
        if (push.firstInRandomOrder == 0u && !isWithinLimit) continue;
        const uint cost = push.firstInRandomOrder == 1u
                              ? (hash(i) >> 1) | (isWithinLimit ? 0u : 0x80000000u)
                              : floatBitsToUint(max(clusterDistance(seed.center, it.voxel, cosine), 0.0));
        atomicMin(bestSeed.data[it.number], (uint64_t(cost) << 32) | uint64_t(i));
    }
}
