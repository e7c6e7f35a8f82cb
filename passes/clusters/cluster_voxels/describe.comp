// What a cluster's voxels are on average: place, normal, reflectance, and their box (Cosin and Patow 2022, algorithm 1, line 15). A
// thread takes a cluster.
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer Members { uint data[]; } members;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer Normals { vec3 data[]; } normals;
layout(scalar) buffer Clusters { VoxelCluster data[]; } clusters;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    VoxelCluster cluster = clusters.data[i];
    vec3 place = vec3(0.0), normal = vec3(0.0), albedo = vec3(0.0);
    float area = 0.0;
    cluster.first = uvec3(0xffffffffu);
    cluster.last = uvec3(0u);
    for (uint k = 0u; k < cluster.members; ++k) {
        const uint voxel = members.data[cluster.firstMember + k];
        const uvec3 at = coordinates.data[voxel];
        const VoxelMaterial m = voxelMaterial(voxel);
        cluster.first = min(cluster.first, at);
        cluster.last = max(cluster.last, at);
        place += vec3(at) + 0.5;
        normal += normals.data[voxel];
        albedo += m.area * m.albedo;
        area += m.area;
    }
    cluster.position = push.grid.origin + push.grid.voxelSize * place / float(cluster.members);
    cluster.normal = dot(normal, normal) > 0.0 ? normalize(normal) : cluster.axis;
    cluster.albedo = area > 0.0 ? albedo / area : vec3(0.0);
    clusters.data[i] = cluster;
}
