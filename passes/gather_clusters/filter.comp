#version 460
#extension GL_GOOGLE_include_directive : require
// Irradiance of faces averaged with the same faces of the voxels round them, by binomial weights; empty voxels and faces without
// surfaces weigh nothing (Cosin and Patow 2022, section 4.4). A thread takes a voxel.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaceValues { vec3 data[]; };
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
layout(scalar) readonly buffer FacesAt { FaceValues faces; };
layout(scalar) readonly buffer FilteredAt { FaceValues filtered; };
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint count;
    int radius;  // 1 or 2.
} push;

// 1 2 1 or 1 4 6 4 1.
float weightAt(int offset) {
    const int away = abs(offset);
    return push.radius == 1 ? (away == 0 ? 2.0 : 1.0) : (away == 0 ? 6.0 : away == 1 ? 4.0 : 1.0);
}

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.count) return;
    const ivec3 center = ivec3(coordinates.data[voxel]);
    vec4 sum[6];
    for (uint face = 0u; face < 6u; ++face) sum[face] = vec4(0.0);
    for (int z = -push.radius; z <= push.radius; ++z)
        for (int y = -push.radius; y <= push.radius; ++y)
            for (int x = -push.radius; x <= push.radius; ++x) {
                const uint other = voxelNumber(push.grid, center + ivec3(x, y, z));
                if (other == NO_VOXEL) continue;
                const float weight = weightAt(x) * weightAt(y) * weightAt(z);
                const VoxelMaterial m = voxelMaterial(other);
                for (uint face = 0u; face < 6u; ++face)
                    if (unoccluded(m, face) > 0.0) sum[face] += weight * vec4(faces.data[6u * other + face], 1.0);
            }
    for (uint face = 0u; face < 6u; ++face)
        filtered.data[6u * voxel + face] = sum[face].w > 0.0 ? sum[face].rgb / sum[face].w : vec3(0.0);
}
