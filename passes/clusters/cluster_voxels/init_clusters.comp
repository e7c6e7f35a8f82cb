// Writes the member range and the seed's normal of each nonempty cluster.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Numbers { uint data[]; } numbers;  // Of each nonempty cluster: its number among all clusters.
readonly buffer MemberCounts { uint data[]; } memberCounts;  // Of all clusters, as `firstMembers` and `newNumbers`.
readonly buffer FirstMembers { uint data[]; } firstMembers;
writeonly buffer NewNumbers { uint data[]; } newNumbers;
layout(scalar) readonly buffer Seeds { ClusterSeed data[]; } seeds;
layout(scalar) readonly buffer Normals { vec3 data[]; } normals;
layout(scalar) writeonly buffer Clusters { VoxelCluster data[]; } clusters;
layout(push_constant) uniform Push {
    uint clusterCount;
    uint seedCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.clusterCount) return;
    const uint number = numbers.data[i];
    newNumbers.data[number] = i;
    clusters.data[i].firstMember = firstMembers.data[number];
    clusters.data[i].memberCount = memberCounts.data[number];
    clusters.data[i].seedNormal =
        number < push.seedCount ? seeds.data[number].normal : normals.data[number - push.seedCount];
}
