// The voxels of a batch that the camera sees a point round and that were not seen before. A thread takes a voxel.
#include "passes/clusters/gather_clusters/seen_points.glsl"
#include "passes/clusters/point_rays.glsl"
layout(local_size_x = 64) in;

writeonly buffer Found { uint data[]; } found;
buffer Count { uint value; } count;

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels || !arrives(i * POINTS, POINTS)) return;
    asked.data[push.firstVoxel + i] = 1u;
    found.data[atomicAdd(count.value, 1u)] = push.firstVoxel + i;
}
