#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Turns the fixed-point sums of voxelize.frag into area-weighted averages.
#include "shaders/linear_index.glsl"
#include "shaders/shared/voxel_types.h"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) readonly buffer Sums { uint data[]; } sums;
layout(set = 0, binding = 1, scalar) writeonly buffer Materials { VoxelMaterial data[]; } materials;
// By voxel: exposed points facing +x -x +y -y +z -z, then all points by axis, weighted by normal component squared.
layout(set = 0, binding = 2) readonly buffer Probes { uint data[]; } probes;
layout(push_constant) uniform Push {
    uint voxelCount;
    float largestEmission;
} push;

vec3 unsignedSum(uint at) { return vec3(sums.data[at], sums.data[at + 1u], sums.data[at + 2u]); }
vec3 signedSum(uint at) { return vec3(int(sums.data[at]), int(sums.data[at + 1u]), int(sums.data[at + 2u])); }

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const uint at = voxel * 13u;
    const float weight = max(float(sums.data[at]), 1.0);
    VoxelMaterial m;
    m.area = float(sums.data[at]) / 65536.0;
    const vec3 axisArea = unsignedSum(at + 1u) / 65536.0;
    for (int axis = 0; axis < 3; ++axis) {
        // A voxel that no point fell into counts as exposed on both sides.
        const float all = float(probes.data[voxel * 9u + 6u + axis]);
        const float positive = all > 0.0 ? float(probes.data[voxel * 9u + 2u * axis]) / all : 1.0;
        const float negative = all > 0.0 ? float(probes.data[voxel * 9u + 2u * axis + 1u]) / all : 1.0;
        m.exposedPositive[axis] = axisArea[axis] * positive;
        m.exposedNegative[axis] = axisArea[axis] * negative;
    }
    m.normal = signedSum(at + 4u) / weight;
    m.albedo = unsignedSum(at + 7u) / weight;
    m.emission = unsignedSum(at + 10u) / weight * push.largestEmission;
    // A flat piece of area A with normal n covers |n_a| A of the voxel's face across axis a, and A n_a² * A is that squared.
    const vec3 covered = sqrt(axisArea * m.area);
    m.opacity = min(1.0, max(covered.x, max(covered.y, covered.z)));
    m.reserved = 0.0;
    m.reserved2 = 0.0;
    m.reserved3 = 0.0;
    materials.data[voxel] = m;
}
