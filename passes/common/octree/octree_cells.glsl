// A voxel of an octree's level in a word: 10 bits for each coordinate.
uint packCell(ivec3 cell) { return uint(cell.x | cell.y << 10 | cell.z << 20); }
ivec3 unpackCell(uint word) { return ivec3(word, word >> 10, word >> 20) & 0x3ff; }
