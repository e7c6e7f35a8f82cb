// Fragment callback: sets the occupancy of each voxel that lists a triangle, nearly transparent ones included.
#ifndef VOXRAY_MARK_LEAVES_GLSL
#define VOXRAY_MARK_LEAVES_GLSL

#include "passes/hybrid_leaves/build_hybrid_leaves/is_listed.glsl"
#include "shaders/voxels/voxels.glsl"

buffer Occupancy { uint words[]; } occupancy;

void processFragment(TriangleFragment f) {
    if (insideGrid(voxelizer.grid, f.voxel) && isListed(f))
        atomicOr(occupancy.words[voxelWord(voxelizer.grid, f.voxel)], voxelBit(voxelizer.grid, f.voxel));
}

#endif
