// Converts merged irradiance to flux on the unoccluded area of each face; writes that area for faces with samples.
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
        for (uint k = 0u; k < 2u; ++k) {
            const float unoccludedArea = unoccluded(m, 2u * axis + k);
            const vec4 merged = mergedIrradiance(2u * pair + k, push.scale);
            watts[k] = merged.rgb * (unoccludedArea * push.voxelSize * push.voxelSize);
            areas[k] = max(areaOf(area.data[pair], k), merged.w > 0.0 ? unoccludedArea : 0.0);
        }
        storeFlux(flux, pair, watts[0], watts[1]);
        area.data[pair] = packAreas(areas[0], areas[1]);
    }
}
