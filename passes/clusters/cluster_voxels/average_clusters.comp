// Averages position, normal and reflectance of each cluster's voxels, and finds their bounding box (Cosin and Patow
// 2022, algorithm 1, line 15).
#include "passes/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer MemberVoxels { uint data[]; } memberVoxels;
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
    vec3 position = vec3(0.0), normal = vec3(0.0), albedo = vec3(0.0);
    float area = 0.0;
    cluster.minVoxel = uvec3(0xffffffffu);
    cluster.maxVoxel = uvec3(0u);
    for (uint k = 0u; k < cluster.memberCount; ++k) {
        const uint voxel = memberVoxels.data[cluster.firstMember + k];
        const uvec3 coordinate = coordinates.data[voxel];
        const VoxelMaterial m = voxelMaterial(voxel);
        cluster.minVoxel = min(cluster.minVoxel, coordinate);
        cluster.maxVoxel = max(cluster.maxVoxel, coordinate);
        position += vec3(coordinate) + 0.5;
        normal += normals.data[voxel];
        albedo += m.area * m.albedo;
        area += m.area;
    }
    cluster.position = push.grid.origin + push.grid.voxelSize * position / float(cluster.memberCount);
    cluster.normal = dot(normal, normal) > 0.0 ? normalize(normal) : cluster.seedNormal;
    cluster.albedo = area > 0.0 ? albedo / area : vec3(0.0);
    clusters.data[i] = cluster;
}
