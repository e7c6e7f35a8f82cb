// Fragment callback: sets the occupancy bit of each voxel that a triangle overlaps.
#ifndef VOXRAY_MARK_VOXELS_GLSL
#define VOXRAY_MARK_VOXELS_GLSL

#include "shaders/voxels/voxels.glsl"

buffer Occupancy { uint words[]; } occupancy;

void processFragment(TriangleFragment f) {
    if (!insideGrid(voxelizer.grid, f.voxel) || !passesAlphaMask(f)) return;
    const uint word = voxelWord(voxelizer.grid, f.voxel), bit = voxelBit(voxelizer.grid, f.voxel);
    if ((occupancy.words[word] & bit) == 0u) atomicOr(occupancy.words[word], bit);
}

#endif
