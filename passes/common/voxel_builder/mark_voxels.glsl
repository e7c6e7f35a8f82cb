// A walk's visitor: sets the occupancy bit of each voxel that a triangle meets.
#ifndef VOXRAY_MARK_VOXELS_GLSL
#define VOXRAY_MARK_VOXELS_GLSL

#include "shaders/voxels/voxels.glsl"

buffer Occupancy { uint words[]; } occupancy;

void visitFragment(TriangleFragment f) {
    if (!insideGrid(walk.grid, f.voxel) || !passesAlphaMask(f)) return;
    const uint word = voxelWord(walk.grid, f.voxel), bit = voxelBit(walk.grid, f.voxel);
    if ((occupancy.words[word] & bit) == 0u) atomicOr(occupancy.words[word], bit);
}

#endif
