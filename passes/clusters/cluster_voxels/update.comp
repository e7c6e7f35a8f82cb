// New centers and mean normals of clusters (Cosin and Patow 2022, algorithm 1, line 13). A thread takes a cluster.
#include "passes/clusters/cluster_voxels/sums.glsl"
#include "passes/clusters/cluster_types.h"
layout(local_size_x = 64) in;

layout(scalar) buffer Seeds { ClusterSeed data[]; } seeds;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint members = uint(sums.data[i * SUMS + 6u]);
    if (members > 0u) {
        vec3 place, normal;
        for (uint k = 0u; k < 3u; ++k) {
            place[k] = float(sums.data[i * SUMS + k]);
            normal[k] = float(int64_t(sums.data[i * SUMS + 3u + k]));
        }
        seeds.data[i].center = place / float(members) + 0.5;
        if (dot(normal, normal) > 0.0) seeds.data[i].normal = normalize(normal);
    }
    seeds.data[i].members = members;
}
