// Over bits with a coarser level (shaders/voxel_march/bricks.glsl): empty cubes of 8, 4 and 2 voxels are left in one step.
#include "shaders/voxel_march/bricks.glsl"

// Words from one block or brick to the next, and to the first brick: worked out once.
uvec3 blockStride, brickStride;
uint firstBrickWord;

void beginWalk(VoxelGrid g) {
    const uvec3 blocks = blockCount(g.resolution), bricks = brickCount(g.resolution);
    blockStride = 2u * uvec3(1u, blocks.x, blocks.x * blocks.y);
    brickStride = 2u * uvec3(1u, bricks.x, bricks.x * bricks.y);
    firstBrickWord = brickWord(g.resolution, uvec3(0u));
}

uint wordIndex(uvec3 at, uvec3 stride) { return at.x * stride.x + at.y * stride.y + at.z * stride.z; }

int emptyCube(ivec3 voxel) {
    const ivec3 brick = voxel >> 2;
    const uint bricks = voxelBricks.words[wordIndex(uvec3(voxel >> 4), blockStride) + wordOf(brick)];
    const uint voxels = voxelBricks.words[firstBrickWord + wordIndex(uvec3(brick), brickStride) + wordOf(voxel)];
    marchVisits += 2u;
    const int cube = isOctantSet(bricks, brick) ? 3 : 7, voxelCube = isOctantSet(voxels, voxel) ? 0 : 1;
    return !isElementSet(bricks, brick) ? cube : isElementSet(voxels, voxel) ? -1 : voxelCube;
}

#include "shaders/voxel_march/walk_cubes.glsl"
