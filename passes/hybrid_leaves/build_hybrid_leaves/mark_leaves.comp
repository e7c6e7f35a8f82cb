// A walk's visitor: sets the occupancy bit of each voxel that a triangle meets, whatever its alpha mask leaves there.
#include "passes/common/triangle_walk/exact.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Occupancy { uint words[]; } occupancy;

void visitFragment(TriangleFragment f) {
    if (insideGrid(walk.grid, f.voxel)) atomicOr(occupancy.words[voxelWord(walk.grid, f.voxel)], voxelBit(walk.grid, f.voxel));
}
