// By the distances of bricks (shaders/voxel_march/distances.glsl), and within a brick by empty cubes of 2 voxels and of one. Both reads
// are taken in each step: neither waits for the other.
#include "shaders/octree/octree_cells.glsl"
#include "shaders/voxel_march/bricks.glsl"
#include "shaders/voxel_march/distance_walk.glsl"

void beginWalk(VoxelGrid g, VoxelSegment s) { beginCells(g, s, BRICK_LEVEL); }

bool emptyBox(ivec3 at, out ivec3 planes) {
    const ivec3 brick = at >> BRICK_LEVEL, voxel = at ^ walkFlip;
    const uint index = cellIndex(brick);
    const uint word = voxelDistances.words[index], bits = voxelBricks.words[2u * index + wordOf(voxel)];
    marchVisits += 2u;
    const ivec3 inBrick = ((word >> octantOf(voxel >> 1) & 1u) != 0u ? at : at | 1) + 1;
    planes = isCellEmpty(word) ? planesAfterCells(brick, word) : inBrick;
    return (bits >> bitOf(voxel) & 1u) == 0u;
}

#include "shaders/voxel_march/walk_boxes.glsl"
