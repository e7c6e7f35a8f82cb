// The area that the flux at each face of a voxel arrives at, in units of a voxel's face: the unoccluded area, and at
// least the lit one, since lit surfaces are visible even if the visibility probes missed that.
#include "passes/common/voxel_builder/surface_accumulator.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer LitArea { uint data[]; } litArea;
layout(scalar) writeonly buffer Area { uint data[]; } area;
layout(push_constant) uniform Push { uint voxelCount; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const VoxelMaterial m = voxelMaterial(voxel);
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint pair = 3u * voxel + axis;
        const vec2 lit = vec2(litArea.data[2u * pair], litArea.data[2u * pair + 1u]) / UNITS_PER_FACE;
        area.data[pair] = packAreas(max(m.unoccludedPositive[axis], lit.x), max(m.unoccludedNegative[axis], lit.y));
    }
}
