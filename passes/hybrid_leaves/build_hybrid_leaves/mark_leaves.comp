// Fragment callback: sets the occupancy of each voxel that a triangle overlaps, nearly transparent ones included.
#include "passes/common/triangle_voxelizer/exact.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Occupancy { uint words[]; } occupancy;

void processFragment(TriangleFragment f) {
    if (insideGrid(voxelizer.grid, f.voxel))
        atomicOr(occupancy.words[voxelWord(voxelizer.grid, f.voxel)], voxelBit(voxelizer.grid, f.voxel));
}
