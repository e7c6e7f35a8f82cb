// Writes the cluster of each voxel by its final index.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Assignment { uint data[]; } assignment;
readonly buffer NewNumbers { uint data[]; } newNumbers;
writeonly buffer ClusterOfVoxel { uint data[]; } clusterOfVoxel;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const uint number = assignment.data[voxel];
    clusterOfVoxel.data[voxel] = number == NO_CLUSTER ? NO_CLUSTER : newNumbers.data[number];
}
