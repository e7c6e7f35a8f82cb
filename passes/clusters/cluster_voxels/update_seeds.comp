// Moves each seed to the mean position and normal of its voxels (Cosin and Patow 2022, algorithm 1, line 13).
#include "passes/clusters/cluster_voxels/cluster_sums.glsl"
#include "passes/clusters/cluster_types.h"
layout(local_size_x = 64) in;

layout(scalar) buffer Seeds { ClusterSeed data[]; } seeds;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint memberCount = uint(sums.data[i * SUMS + 6u]);
    if (memberCount > 0u) {
        vec3 position, normal;
        for (uint k = 0u; k < 3u; ++k) {
            position[k] = float(sums.data[i * SUMS + k]);
            normal[k] = float(int64_t(sums.data[i * SUMS + 3u + k]));
        }
        seeds.data[i].center = position / float(memberCount) + 0.5;
        if (dot(normal, normal) > 0.0) seeds.data[i].normal = normalize(normal);
    }
    seeds.data[i].memberCount = memberCount;
}
