// Occupancy bits once more, by bricks of 4x4x4 voxels in rows along x: bit x + 4 y + 16 z of a brick is a voxel of it. 64 bits each, the
// low word first.
#ifndef VOXRAY_VOXEL_BRICKS_GLSL
#define VOXRAY_VOXEL_BRICKS_GLSL

#define BRICK_LEVEL 2  // A brick is 2^2 voxels wide.

buffer VoxelBricks { uint words[]; } voxelBricks;

// Of a voxel of a brick: which of the two words its bit is in, and the bit.
uint wordOf(ivec3 voxel) { return uint(voxel.z >> 1 & 1); }
uint bitOf(ivec3 voxel) { return uint((voxel.x & 3) | (voxel.y & 3) << 2 | (voxel.z & 1) << 4); }

#endif
