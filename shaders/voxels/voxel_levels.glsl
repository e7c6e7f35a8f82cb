// Surface voxels of one or more levels (host: VoxelLevels of passes/common/voxels/voxels.h).
#ifndef VOXRAY_VOXEL_LEVELS_GLSL
#define VOXRAY_VOXEL_LEVELS_GLSL

#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer VoxelLevels { VoxelLevel data[]; } voxelLevels;

bool isHeld(VoxelLevel level, ivec3 voxel) {
    return all(greaterThanEqual(voxel, level.first)) && all(lessThan(voxel, level.end));
}

// The grid of the finest level that holds a position.
VoxelGrid gridAt(vec3 position) {
    const uint last = uint(voxelLevels.data.length()) - 1u;
    uint level = 0u;
    while (level < last && !isHeld(voxelLevels.data[level], voxelAt(voxelLevels.data[level].grid, position))) ++level;
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
