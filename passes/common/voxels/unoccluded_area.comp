// Writes the unoccluded area of each voxel's surfaces, by face.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

writeonly buffer Area { uint data[]; } area;
layout(push_constant) uniform Push { uint voxelCount; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const VoxelMaterial m = voxelMaterial(voxel);
    for (uint axis = 0u; axis < 3u; ++axis)
        area.data[3u * voxel + axis] = packAreas(m.unoccludedPositive[axis], m.unoccludedNegative[axis]);
}
