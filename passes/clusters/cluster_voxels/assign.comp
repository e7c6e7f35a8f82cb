// Each cluster asks for the voxels in its reach (Cosin and Patow 2022, algorithm 1, lines 4 to 12). A voxel goes to the least distance,
// then to the first seed: a total order, so threads may run in any.
// - nearest: by place and normal, of the clusters whose normals are within the angle limit.
// - first: by equation 1, which is 1 within the limit though line 7 minimizes: it is read as 0 within the limit and 1 beyond. Of equal
//   ones whoever comes first in a random order has the voxel. So a voxel that no cluster within the limit reaches goes to another one
//   (section 4.2: a cluster takes what it tests for the first time, whatever the angle).
#include "passes/clusters/cluster_voxels/neighbourhood.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Seeds { ClusterSeed data[]; } seeds;
layout(scalar) buffer Nearest { uint64_t data[]; } nearest;  // By voxel: distance, then number of the seed.

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ClusterSeed seed = seeds.data[i];
    if (seed.members == 0u) return;
    ivec3 first, last;
    boxWithinReach(seed.center, first, last);
    for (BoxWalk w = walkBox(first, last); nextVoxel(w);) {
        const float cosine = dot(seed.normal, normals.data[w.number]);
        const bool isWithin = cosine >= push.minCosine;
        if (push.first == 0u && !isWithin) continue;
        const uint away = push.first == 1u ? (hash(i) >> 1) | (isWithin ? 0u : 0x80000000u)
                                           : floatBitsToUint(max(clusterDistance(seed.center, w.voxel, cosine), 0.0));
        atomicMin(nearest.data[w.number], (uint64_t(away) << 32) | uint64_t(i));
    }
}
