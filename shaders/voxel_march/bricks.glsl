// Occupancy in bricks of 4x4x4 voxels, which are stored in rows along x: 64 bits a brick, low word first. Bit x + 4 y +
// 16 z is a voxel.
#ifndef VOXRAY_VOXEL_BRICKS_GLSL
#define VOXRAY_VOXEL_BRICKS_GLSL

#define BRICK_LEVEL 2  // A brick is 2^2 voxels wide.

buffer VoxelBricks { uint words[]; } voxelBricks;

// The word of the brick, 0 or 1, that holds a voxel's bit, and the bit's index in it.
uint wordOf(ivec3 voxel) { return uint(voxel.z >> 1 & 1); }
uint bitOf(ivec3 voxel) { return uint((voxel.x & 3) | (voxel.y & 3) << 2 | (voxel.z & 1) << 4); }

#endif
