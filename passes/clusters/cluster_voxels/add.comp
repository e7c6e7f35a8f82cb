// Adds each voxel's place and normal to its cluster's sums, in whole numbers: the same in any order. A thread takes a voxel.
#include "passes/clusters/cluster_voxels/sums.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Nearest { uint64_t data[]; } nearest;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer Normals { vec3 data[]; } normals;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count || nearest.data[voxel] == ~0ul) return;
    const uint cluster = uint(nearest.data[voxel] & 0xfffffffful);
    for (uint k = 0u; k < 3u; ++k) {
        atomicAdd(sums.data[cluster * SUMS + k], uint64_t(coordinates.data[voxel][k]));
        atomicAdd(sums.data[cluster * SUMS + 3u + k], uint64_t(int64_t(round(normals.data[voxel][k] * NORMAL_UNITS))));
    }
    atomicAdd(sums.data[cluster * SUMS + 6u], 1ul);
}
