// Surface voxels of one or more levels (host: VoxelLevels of passes/common/voxels/voxels.h).
#ifndef VOXRAY_VOXEL_LEVELS_GLSL
#define VOXRAY_VOXEL_LEVELS_GLSL

#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer VoxelLevels { VoxelLevel data[]; } voxelLevels;

// Whether a voxel of a level but the finest is split: the finer level holds its place. Split bits of all these levels
// follow the occupancy bits of all levels, where voxels are split at all; ranks have occupancy's words alone.
bool isSplit(VoxelGrid g, ivec3 voxel) {
    const uint word = uint(voxelRank.before.length()) - voxelLevels.data[1].grid.firstWord + voxelWord(g, voxel);
    return insideGrid(g, voxel) && (voxelOccupancy.words[word] & voxelBit(g, voxel)) != 0u;
}

// Whether a level holds a voxel of its own: one of its window, and where voxels are split, one of a split voxel.
bool isHeld(uint level, ivec3 voxel) {
    const VoxelLevel l = voxelLevels.data[level];
    if (any(lessThan(voxel, l.first)) || any(greaterThanEqual(voxel, l.end))) return false;
    const bool hasSplits = voxelOccupancy.words.length() > voxelRank.before.length();
    return !hasSplits || level + 1u == uint(voxelLevels.data.length()) ||
           isSplit(voxelLevels.data[level + 1u].grid, voxel >> 1);
}

// The grid of the finest level that holds a position.
VoxelGrid gridAt(vec3 position) {
    const uint last = uint(voxelLevels.data.length()) - 1u;
    uint level = 0u;
    while (level < last && !isHeld(level, voxelAt(voxelLevels.data[level].grid, position))) ++level;
    return voxelLevels.data[level].grid;
}

// Edge of a voxel, m, by its number.
float voxelSizeOf(uint voxel) {
    const uint last = uint(voxelLevels.data.length()) - 1u;
    uint level = 0u;
    while (level < last && voxel >= voxelRank.before[voxelLevels.data[level + 1u].grid.firstWord]) ++level;
    return voxelLevels.data[level].grid.voxelSize;
}

#endif
