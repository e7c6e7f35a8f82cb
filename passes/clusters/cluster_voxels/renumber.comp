// Each voxel's cluster by its final number, and pairs of both for sorting: voxels without a cluster come last. A thread takes a voxel.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Owners { uint data[]; } owners;
readonly buffer Renumbered { uint data[]; } renumbered;
writeonly buffer OfVoxel { uint data[]; } ofVoxel;
writeonly buffer Keys { uint data[]; } keys;
writeonly buffer Members { uint data[]; } members;
layout(push_constant) uniform Push {
    uint count;
    uint clusters;
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const uint owner = owners.data[voxel];
    const uint cluster = owner == NO_CLUSTER ? NO_CLUSTER : renumbered.data[owner];
    ofVoxel.data[voxel] = cluster;
    keys.data[voxel] = min(cluster, push.clusters);
    members.data[voxel] = voxel;
}
