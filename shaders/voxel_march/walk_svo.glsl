// Through the octree from one level's nodes on down. Where such a node is not there its word tells distances instead
// (shaders/voxel_march/distances.glsl), so a step through empty space takes one word.
#include "shaders/octree/octree.glsl"
#include "shaders/voxel_march/distance_walk.glsl"

readonly buffer VoxelNodes { uint words[]; } voxelNodes;

void beginWalk(VoxelGrid g, VoxelSegment s) { beginCells(g, s, distanceLevel(octree.shape.tableLevel, octree.shape.levels)); }

bool emptyBox(ivec3 at, out ivec3 planes) {
    const ivec3 cell = at >> cellLevel, voxel = at ^ walkFlip;
    uint word = voxelDistances.words[cellIndex(cell)];
    ++marchVisits;
    planes = planesAfterCells(cell, word);
    if (isCellEmpty(word)) return true;
    // Down to the smallest node around the voxel, of which an octant is empty or the voxel itself.
    int level = cellLevel - 1;
    for (; level > 0; --level) {
        const uint octant = octantOf(voxel >> level);
        if ((word >> octant & 1u) == 0u) break;
        word = voxelNodes.words[octreeChild(word, octant)];
        ++marchVisits;
    }
    planes = ((at >> level) + 1) << level;
    return (word >> octantOf(voxel >> level) & 1u) == 0u;
}

#include "shaders/voxel_march/walk_boxes.glsl"
