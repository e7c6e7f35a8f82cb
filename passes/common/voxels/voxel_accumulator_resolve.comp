#version 460
#extension GL_GOOGLE_include_directive : require
// Merged irradiance to flux over the exposed area of each face, and that area where a sample fell.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxel_accumulator.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer FluxAt { LargeFloats flux; };
layout(scalar) buffer Area { float data[]; } area;
layout(push_constant) uniform Push {
    uint voxelCount;
    float voxelSize;
    float scale;
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const VoxelMaterial m = voxelMaterials.data[voxel];
    for (uint direction = 0u; direction < 6u; ++direction) {
        const uint face = voxel * 6u + direction;
        const float exposed = (direction & 1u) == 0u ? m.unoccludedPositive[direction / 2u] : m.unoccludedNegative[direction / 2u];
        const vec4 merged = mergedIrradiance(face, push.scale);
        const vec3 watts = merged.rgb * (exposed * push.voxelSize * push.voxelSize);
        for (uint c = 0u; c < 3u; ++c) flux.data[face * 3u + c] = watts[c];
        if (merged.w > 0.0) area.data[face] = max(area.data[face], exposed);
    }
}
