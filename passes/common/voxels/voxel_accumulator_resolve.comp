// Merged irradiance to flux over the unoccluded area of each face, and that area where a sample fell.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/packed_flux.glsl"
#include "shaders/voxels/voxel_accumulator.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer FluxRef { LargeUints flux; };
layout(scalar) buffer Area { uint data[]; } area;
layout(push_constant) uniform Push {
    uint voxelCount;
    float voxelSize;
    float scale;
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    const VoxelMaterial m = voxelMaterial(voxel);
    for (uint axis = 0u; axis < 3u; ++axis) {
        const uint pair = 3u * voxel + axis;
        vec3 watts[2];
        float areas[2];
        for (uint side = 0u; side < 2u; ++side) {
            const float unoccludedArea = unoccluded(m, 2u * axis + side);
            const vec4 merged = mergedIrradiance(2u * pair + side, push.scale);
            watts[side] = merged.rgb * (unoccludedArea * push.voxelSize * push.voxelSize);
            areas[side] = max(areaOf(area.data[pair], side), merged.w > 0.0 ? unoccludedArea : 0.0);
        }
        storeFlux(flux, pair, watts[0], watts[1]);
        area.data[pair] = packAreas(areas[0], areas[1]);
    }
}
