#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Occupancy by bricks (BRICKS), then by blocks of bricks (BLOCKS). A thread makes one.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxel_march/bricks.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Push { VoxelGrid grid; } push;

#ifdef BRICKS
bool isSet(ivec3 voxel) { return isOccupied(push.grid, voxel); }
#else
bool isSet(ivec3 brick) {
    if (any(greaterThanEqual(brick, ivec3(brickCount(push.grid.resolution))))) return false;
    const uint index = brickWord(push.grid.resolution, uvec3(brick));
    return (voxelBricks.words[index] | voxelBricks.words[index + 1u]) != 0u;
}
#endif

void main() {
    const uvec3 resolution = push.grid.resolution;
#ifdef BRICKS
    const uvec3 count = brickCount(resolution);
#else
    const uvec3 count = blockCount(resolution);
#endif
    const uint i = linearIndex();
    if (i >= count.x * count.y * count.z) return;
    const uvec3 at = uvec3(i % count.x, i / count.x % count.y, i / count.x / count.y);
    uvec2 mask = uvec2(0u);
    for (uint bit = 0u; bit < 64u; ++bit)
        if (isSet(ivec3(4u * at + (uvec3(bit, bit >> 2, bit >> 4) & 3u)))) mask[bit >> 5] |= 1u << (bit & 31u);
#ifdef BRICKS
    const uint index = brickWord(resolution, at);
#else
    const uint index = blockWord(resolution, at);
#endif
    voxelBricks.words[index] = mask.x;
    voxelBricks.words[index + 1u] = mask.y;
}
