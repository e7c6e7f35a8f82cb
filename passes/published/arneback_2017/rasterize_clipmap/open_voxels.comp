// Empties the voxels of a box, which are then rasterized.
#include "passes/published/arneback_2017/rasterize_clipmap/lit_voxels.glsl"
#include "passes/published/arneback_2017/rasterize_clipmap/region_box.glsl"
layout(local_size_x = 64) in;

void main() {
    ivec3 voxel;
    if (!voxelOfBox(voxel) || !isInRegion(voxel)) return;
    litVoxels.data[push.firstVoxel + indexInRegion(push.first, push.end, voxel)] = 0ul;
}
