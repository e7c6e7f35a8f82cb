// What the walks by distances have in common (shaders/voxel_march/distances.glsl).
#include "shaders/voxel_march/distances.glsl"

readonly buffer VoxelDistances { uint words[]; } voxelDistances;

// Worked out once: where the words of cells stand, which are counted mirrored as all along the segment, and where a word tells the
// distance in the segment's octant.
int firstCell, cellLevel, walkShift;
ivec3 cellStride, walkFlip;

void beginCells(VoxelGrid g, VoxelSegment s, int level) {
    const ivec3 count = cellCount(g.resolution, level), stride = ivec3(1, count.x, count.x * count.y);
    const bvec3 isDown = notEqual(s.flip, ivec3(0));
    const ivec3 last = stride * (s.flip >> level);
    cellLevel = level;
    firstCell = last.x + last.y + last.z;
    cellStride = mix(stride, -stride, isDown);
    walkFlip = s.flip;
    walkShift = distanceShift(uint(isDown.x) | uint(isDown.y) << 1 | uint(isDown.z) << 2);
}

uint cellIndex(ivec3 cell) { return uint(firstCell + cell.x * cellStride.x + cell.y * cellStride.y + cell.z * cellStride.z); }

// Where what is empty before an empty cell ends.
ivec3 planesAfterCells(ivec3 cell, uint word) { return (cell + int(word >> walkShift & 7u)) << cellLevel; }
