// Occupancy bits once more, by bricks of 4x4x4 voxels: bit x + 4 y + 16 z of a brick is a voxel of it. Above them, in the same way,
// blocks of 4x4x4 bricks: a bit for each brick that is not empty. 64 bits each, low words first; blocks stand first, then bricks,
// both in rows along x.
#ifndef VOXRAY_VOXEL_BRICKS_GLSL
#define VOXRAY_VOXEL_BRICKS_GLSL

buffer VoxelBricks { uint words[]; } voxelBricks;

uvec3 brickCount(uvec3 resolution) { return (resolution + 3u) / 4u; }
uvec3 blockCount(uvec3 resolution) { return (resolution + 15u) / 16u; }

// Where the bits of a block and of a brick stand.
uint blockWord(uvec3 resolution, uvec3 block) {
    const uvec3 count = blockCount(resolution);
    return 2u * ((block.z * count.y + block.y) * count.x + block.x);
}
uint brickWord(uvec3 resolution, uvec3 brick) {
    const uvec3 count = brickCount(resolution), blocks = blockCount(resolution);
    return 2u * (blocks.x * blocks.y * blocks.z + (brick.z * count.y + brick.y) * count.x + brick.x);
}

// Of an element of a block or brick: which of the two words its bit is in, and whether it and the 2x2x2 elements around it are set.
uint wordOf(ivec3 element) { return uint(element.z >> 1 & 1); }
bool isElementSet(uint word, ivec3 element) {
    return (word >> ((element.x & 3) | (element.y & 3) << 2 | (element.z & 1) << 4) & 1u) != 0u;
}
bool isOctantSet(uint word, ivec3 element) { return (word >> ((element.x & 2) | (element.y & 2) << 2) & 0x00330033u) != 0u; }

#endif
