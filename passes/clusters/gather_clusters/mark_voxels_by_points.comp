// Marks and lists the voxels of a batch of which the camera sees a point. Rays of voxels that were requested before are
// inactive.
#include "passes/clusters/gather_clusters/visible_points.glsl"
#include "passes/clusters/voxel_point_rays.glsl"
layout(local_size_x = 64) in;

writeonly buffer NewVoxels { uint data[]; } newVoxels;
buffer Count { uint value; } count;

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels || !anyUnoccluded(i * POINTS, POINTS)) return;
    requestedVoxels.data[push.firstVoxel + i] = 1u;
    newVoxels.data[atomicAdd(count.value, 1u)] = push.firstVoxel + i;
}
