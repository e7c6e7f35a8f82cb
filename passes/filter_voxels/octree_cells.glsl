// Cells of an octree's level in a word: 10 bits for each coordinate.
uint packCell(uvec3 cell) { return cell.x | cell.y << 10 | cell.z << 20; }
uvec3 unpackCell(uint word) { return uvec3(word, word >> 10, word >> 20) & 0x3ffu; }
