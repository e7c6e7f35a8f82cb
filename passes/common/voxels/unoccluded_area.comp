#version 460
#extension GL_GOOGLE_include_directive : require
// The exposed area of each voxel's surfaces by the six directions +x -x +y -y +z -z, in units of a voxel's face.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Area { float data[]; } area;
layout(push_constant) uniform Push { uint voxelCount; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const VoxelMaterial m = voxelMaterials.data[voxel];
    for (uint axis = 0u; axis < 3u; ++axis) {
        area.data[voxel * 6u + 2u * axis] = m.unoccludedPositive[axis];
        area.data[voxel * 6u + 2u * axis + 1u] = m.unoccludedNegative[axis];
    }
}
