// Writes the cluster of each voxel by its final index, and sort keys by which voxels without a cluster come last.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Assignment { uint data[]; } assignment;
readonly buffer NewNumbers { uint data[]; } newNumbers;
writeonly buffer ClusterOfVoxel { uint data[]; } clusterOfVoxel;
writeonly buffer Keys { uint data[]; } keys;
writeonly buffer MemberVoxels { uint data[]; } memberVoxels;
layout(push_constant) uniform Push {
    uint count;
    uint clusters;
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const uint number = assignment.data[voxel];
    const uint cluster = number == NO_CLUSTER ? NO_CLUSTER : newNumbers.data[number];
    clusterOfVoxel.data[voxel] = cluster;
    keys.data[voxel] = min(cluster, push.clusters);
    memberVoxels.data[voxel] = voxel;
}
