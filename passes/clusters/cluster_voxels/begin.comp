// Clusters that have voxels: where their members begin, and the normal that these were compared with. A thread takes a cluster.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Numbers { uint data[]; } numbers;  // By cluster: the number that it had.
readonly buffer Members { uint data[]; } members;  // By that number, as `before` and `renumbered`.
readonly buffer Before { uint data[]; } before;
writeonly buffer Renumbered { uint data[]; } renumbered;
layout(scalar) readonly buffer Seeds { ClusterSeed data[]; } seeds;
layout(scalar) readonly buffer Normals { vec3 data[]; } normals;
layout(scalar) writeonly buffer Clusters { VoxelCluster data[]; } clusters;
layout(push_constant) uniform Push {
    uint clusterCount;
    uint firstOwn;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.clusterCount) return;
    const uint number = numbers.data[i];
    renumbered.data[number] = i;
    clusters.data[i].firstMember = before.data[number];
    clusters.data[i].members = members.data[number];
    clusters.data[i].axis = number < push.firstOwn ? seeds.data[number].normal : normals.data[number - push.firstOwn];
}
