// Coordinates of an octree's voxels packed in a word, 10 bits each; octants.
#ifndef VOXRAY_OCTREE_CELLS_GLSL
#define VOXRAY_OCTREE_CELLS_GLSL

uint packCell(ivec3 cell) { return uint(cell.x | cell.y << 10 | cell.z << 20); }
ivec3 unpackCell(uint word) { return ivec3(word, word >> 10, word >> 20) & 0x3ff; }

// Octants are numbered x + 2 y + 4 z.
uint octantOf(ivec3 voxel) { return uint((voxel.x & 1) | (voxel.y & 1) << 1 | (voxel.z & 1) << 2); }
ivec3 octantOffset(uint octant) { return ivec3(octant & 1u, octant >> 1 & 1u, octant >> 2); }

#endif
