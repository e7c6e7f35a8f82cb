#version 460
#extension GL_GOOGLE_include_directive : require
// The area that the flux at each face of a voxel is spread over, in units of a voxel's face: the unoccluded area. A surface that light
// reaches is visible, whatever the visibility probes found: so the area is at least the lit one.
#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer LitArea { uint data[]; } litArea;
layout(scalar) writeonly buffer Area { float data[]; } area;
layout(push_constant) uniform Push { uint voxelCount; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const VoxelMaterial m = voxelMaterials.data[voxel];
    for (uint face = 0u; face < 6u; ++face) {
        const float unoccluded = (face & 1u) == 0u ? m.unoccludedPositive[face >> 1] : m.unoccludedNegative[face >> 1];
        area.data[6u * voxel + face] = max(unoccluded, float(litArea.data[6u * voxel + face]) / UNITS_PER_FACE);
    }
}
