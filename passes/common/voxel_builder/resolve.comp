#version 460
#extension GL_GOOGLE_include_directive : require
// Turns the fixed-point sums of voxel_sums.glsl into area-weighted averages.
#include "passes/common/voxel_builder/sums_layout.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer SumsAt { LargeUints sums; };
// By voxel: exposed points facing +x -x +y -y +z -z, then all points by axis, weighted by normal component squared.
layout(set = 0, binding = 2) readonly buffer Probes { uint data[]; } probes;
layout(push_constant) uniform Push {
    uint voxelCount;
    float largestEmission;
} push;

vec3 unsignedSum(uint at) { return vec3(sums.data[at], sums.data[at + 1u], sums.data[at + 2u]); }
vec3 signedSum(uint at) { return vec3(int(sums.data[at]), int(sums.data[at + 1u]), int(sums.data[at + 2u])); }
float coverage(uint mask) { return float(bitCount(mask)) / 16.0; }

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const uint at = voxel * SUMS_PER_VOXEL;
    const float weight = max(float(sums.data[at + SUM_AREA]), 1.0);
    VoxelMaterial m;
    m.area = float(sums.data[at + SUM_AREA]) / UNITS_PER_FACE;
    const vec3 axisArea = unsignedSum(at + SUM_AXIS_AREA) / UNITS_PER_FACE;
    for (int axis = 0; axis < 3; ++axis) {
        // A voxel that no point fell into counts as exposed on both sides.
        const float all = float(probes.data[voxel * 9u + 6u + axis]);
        const float positive = all > 0.0 ? float(probes.data[voxel * 9u + 2u * axis]) / all : 1.0;
        const float negative = all > 0.0 ? float(probes.data[voxel * 9u + 2u * axis + 1u]) / all : 1.0;
        m.unoccludedPositive[axis] = axisArea[axis] * positive;
        m.unoccludedNegative[axis] = axisArea[axis] * negative;
    }
    m.normal = signedSum(at + SUM_NORMAL) / weight;
    m.albedo = unsignedSum(at + SUM_ALBEDO) / weight;
    m.emission = unsignedSum(at + SUM_EMISSION) / weight * push.largestEmission;
    m.metallic = float(sums.data[at + SUM_METALLIC]) / weight;
    m.roughness = float(sums.data[at + SUM_ROUGHNESS]) / weight;
    const uint covered = at + SUM_COVERED;
    m.opacity = max(coverage(sums.data[covered]), max(coverage(sums.data[covered + 1u]), coverage(sums.data[covered + 2u])));
    m.reserved = 0.0;
    voxelMaterials.data[voxel] = m;
}
