// Turns the fixed-point sums of the surface accumulator into area-weighted averages.
#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SurfaceAccumulatorRef { LargeUints surfaceAccumulator; };
// Nine per voxel (count_visible_points.comp): visible points by face +x -x +y -y +z -z, then all points by axis.
readonly buffer Visibility { uint data[]; } visibility;
layout(push_constant) uniform Push {
    uint voxelCount;
    float largestEmission;
} push;

uint sum(uint at) { return surfaceAccumulator.data[at]; }
vec3 unsignedSum(uint at) { return vec3(sum(at), sum(at + 1u), sum(at + 2u)); }
vec3 signedSum(uint at) { return vec3(int(sum(at)), int(sum(at + 1u)), int(sum(at + 2u))); }
float opacity(uint subSamples) { return float(bitCount(subSamples)) / 16.0; }

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const uint at = voxel * ACCUMULATOR_UINTS;
    const float weight = max(float(sum(at + SUM_AREA)), 1.0);
    VoxelMaterial m;
    m.area = float(sum(at + SUM_AREA)) / UNITS_PER_FACE;
    const vec3 axisArea = unsignedSum(at + SUM_AXIS_AREA) / UNITS_PER_FACE;
    for (int axis = 0; axis < 3; ++axis) {
        // Surfaces of a voxel without probe points count as visible from both sides
        const float all = float(visibility.data[voxel * 9u + 6u + axis]);
        const float positive = all > 0.0 ? float(visibility.data[voxel * 9u + 2u * axis]) / all : 1.0;
        const float negative = all > 0.0 ? float(visibility.data[voxel * 9u + 2u * axis + 1u]) / all : 1.0;
        m.unoccludedPositive[axis] = axisArea[axis] * positive;
        m.unoccludedNegative[axis] = axisArea[axis] * negative;
    }
    m.normal = signedSum(at + SUM_NORMAL) / weight;
    m.albedo = unsignedSum(at + SUM_ALBEDO) / weight;
    m.emission = unsignedSum(at + SUM_EMISSION) / weight * push.largestEmission;
    m.metallic = float(sum(at + SUM_METALLIC)) / weight;
    m.roughness = float(sum(at + SUM_ROUGHNESS)) / weight;
    m.opacity = max(opacity(sum(at + SUB_SAMPLES)),
                    max(opacity(sum(at + SUB_SAMPLES + 1u)), opacity(sum(at + SUB_SAMPLES + 2u))));
    voxelMaterials.data[voxel] = packMaterial(m);
}
