// Traverses the octree from the nodes of one level down. Where there is no such node its word holds distances instead
// (shaders/voxel_march/distances.glsl), so that a step through empty space reads one word.
#include "shaders/octree/octree.glsl"
#include "shaders/voxel_march/distance_traversal.glsl"

readonly buffer VoxelNodes { uint words[]; } voxelNodes;

void initTraversal(VoxelGrid g, VoxelSegment s) {
    initCells(g, s, distanceLevel(octree.shape.tableLevel, octree.shape.levels));
}

bool findEmptyBox(ivec3 flipped, out ivec3 planes) {
    const ivec3 cell = flipped >> cellLevel, voxel = flipped ^ segmentFlip;
    uint word = voxelDistances.words[cellIndex(cell)];
    ++marchVisits;
    planes = emptyBoxEnd(cell, word);
    if (isCellEmpty(word)) return true;
    // Descend to the smallest node around the voxel: one with an empty octant there, or the voxel itself
    int level = cellLevel - 1;
    for (; level > 0; --level) {
        const uint octant = octantOf(voxel >> level);
        if ((word >> octant & 1u) == 0u) break;
        word = voxelNodes.words[octreeChild(word, octant)];
        ++marchVisits;
    }
    planes = ((flipped >> level) + 1) << level;
    return (word >> octantOf(voxel >> level) & 1u) == 0u;
}

#include "shaders/voxel_march/traverse_boxes.glsl"
