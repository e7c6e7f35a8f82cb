// Stores the voxels of a box in the clipmap: the mean radiance of their lit fragments, and an opacity of 1 with any
// fragment (Arnebäck 2017, section 4.2). Voxels outside of the level's grid are empty.
#include "passes/cones/radiance/radiance_voxels.glsl"
#include "passes/published/arneback_2017/rasterize_clipmap/lit_voxels.glsl"
#include "passes/published/arneback_2017/rasterize_clipmap/region_box.glsl"
layout(local_size_x = 64) in;

void main() {
    ivec3 voxel;
    if (!voxelOfBox(voxel)) return;
    vec4 value = vec4(0.0);
    if (isInRegion(voxel)) {
        const uint index = push.firstVoxel + indexInRegion(push.first, push.end, voxel);
        const LitVoxel lit = unpackVoxel(litVoxels.data[index]);
        value = vec4(radianceVoxels.grid.unit * lit.radiance, lit.isOpaque ? 1.0 : 0.0);
    }
    storeRadiance(radianceIndex(push.level, voxel), 0u, value);
}
