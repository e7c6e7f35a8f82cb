// Adds the position and the normal of each voxel to the sums of its cluster.
#include "passes/clusters/cluster_voxels/cluster_sums.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer BestSeed { uint64_t data[]; } bestSeed;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer Normals { vec3 data[]; } normals;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count || bestSeed.data[voxel] == ~0ul) return;
    const uint seed = uint(bestSeed.data[voxel] & 0xfffffffful);
    for (uint k = 0u; k < 3u; ++k) {
        atomicAdd(sums.data[seed * SUMS + k], uint64_t(coordinates.data[voxel][k]));
        atomicAdd(sums.data[seed * SUMS + 3u + k], uint64_t(int64_t(round(normals.data[voxel][k] * NORMAL_UNITS))));
    }
    atomicAdd(sums.data[seed * SUMS + 6u], 1ul);
}
