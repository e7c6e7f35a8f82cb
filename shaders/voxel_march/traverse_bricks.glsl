// Traverses bricks by their distances (shaders/voxel_march/distances.glsl), and within a brick empty cubes of 2 voxels
// or one. Each step reads the distance and the brick's bits at once, so that neither read waits for the other.
#include "shaders/octree/octree_cells.glsl"
#include "shaders/voxel_march/bricks.glsl"
#include "shaders/voxel_march/distance_traversal.glsl"

void initTraversal(VoxelGrid g, VoxelSegment s) { initCells(g, s, BRICK_LEVEL); }

bool findEmptyBox(ivec3 flipped, out ivec3 planes) {
    const ivec3 brick = flipped >> BRICK_LEVEL, voxel = flipped ^ segmentFlip;
    const uint index = cellIndex(brick);
    const uint word = voxelDistances.words[index], bits = voxelBricks.words[2u * index + wordOf(voxel)];
    marchVisits += 2u;
    const ivec3 inBrick = ((word >> octantOf(voxel >> 1) & 1u) != 0u ? flipped : flipped | 1) + 1;
    planes = isCellEmpty(word) ? emptyBoxEnd(brick, word) : inBrick;
    return (bits >> bitOf(voxel) & 1u) == 0u;
}

#include "shaders/voxel_march/traverse_boxes.glsl"
