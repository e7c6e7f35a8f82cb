// Writes the seed's normal and the number of voxels of each nonempty cluster, and assigns consecutive indices to them.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Numbers { uint data[]; } numbers;  // Per nonempty cluster: its number among all clusters.
readonly buffer MemberCounts { uint data[]; } memberCounts;  // Per cluster, as `newNumbers`.
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
    const vec3 seedNormal =
        number < push.seedCount ? seeds.data[number].normal : normals.data[number - push.seedCount];
    clusters.data[i] = VoxelCluster(seedNormal, memberCounts.data[number]);
}
