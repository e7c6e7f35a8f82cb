// Shared by the traversals by distances (shaders/voxel_march/distances.glsl).
#include "shaders/voxel_march/distances.glsl"

readonly buffer VoxelDistances { uint words[]; } voxelDistances;

// Constants of a segment: index and strides of its flipped cells, and the shift of its octant's distance in a word.
int firstCell, cellLevel, octantShift;
ivec3 cellStride, segmentFlip;

void initCells(VoxelGrid g, VoxelSegment s, int level) {
    const ivec3 count = cellCount(g.resolution, level), stride = ivec3(1, count.x, count.x * count.y);
    const bvec3 isDown = notEqual(s.flip, ivec3(0));
    const ivec3 last = stride * (s.flip >> level);
    cellLevel = level;
    firstCell = last.x + last.y + last.z;
    cellStride = mix(stride, -stride, isDown);
    segmentFlip = s.flip;
    octantShift = distanceShift(uint(isDown.x) | uint(isDown.y) << 1 | uint(isDown.z) << 2);
}

uint cellIndex(ivec3 cell) {
    return uint(firstCell + cell.x * cellStride.x + cell.y * cellStride.y + cell.z * cellStride.z);
}

// End of the empty box in front of an empty cell, in voxels.
ivec3 emptyBoxEnd(ivec3 cell, uint word) { return (cell + int(word >> octantShift & 7u)) << cellLevel; }
