#version 460
#extension GL_GOOGLE_include_directive : require
// Radiosity of clusters' faces: the mean of their voxels', by area (Cosin and Patow 2022, section 4.4: irradiance is pulled up to
// clusters). A thread takes a cluster; its voxels come in their order, so sums are the same in each run.
//
// The ratio of two small samples could outshine a scene. So a face with less than SMALL_FACE_AREA sends what its cluster does, and a
// cluster with less than that no more than its flux over so much.
#include "shaders/clusters/cluster_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) readonly buffer Clusters { VoxelCluster data[]; } clusters;
layout(scalar) readonly buffer Members { uint data[]; } members;
layout(scalar) readonly buffer RadiosityAt { FaceValues radiosity; };
layout(scalar) writeonly buffer Sent { vec3 data[]; } sent;
layout(push_constant) uniform Push { uint clusters; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.clusters) return;
    const uint first = clusters.data[i].firstMember, count = clusters.data[i].members;
    for (uint face = 0u; face < 6u; ++face) {
        vec3 sum = vec3(0.0);
        float area = 0.0;
        for (uint k = 0u; k < count; ++k) {
            const uint voxel = members.data[first + k];
            const float own = unoccluded(voxelMaterial(voxel), face);
            if (own == 0.0) continue;
            sum += own * radiosity.data[6u * voxel + face];
            area += own;
        }
        const vec3 mean = sum / max(area, SMALL_FACE_AREA);
        sent.data[6u * i + face] = mean;
        for (uint k = 0u; k < count; ++k) {
            const uint voxel = members.data[first + k];
            if (unoccluded(voxelMaterial(voxel), face) < SMALL_FACE_AREA) radiosity.data[6u * voxel + face] = mean;
        }
    }
}
