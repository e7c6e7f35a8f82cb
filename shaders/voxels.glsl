// Access to surface voxels: an occupancy bit for each voxel of the grid and, where it is set, the voxel's number
// among the occupied ones (its rank), which indexes all per-voxel data. Empty space costs two bits a voxel, nothing else.
// Bindings 8 to 10 of set 0. The including shader has a VoxelGrid named `grid` in its push constants.
#ifndef VOXRAY_VOXELS_GLSL
#define VOXRAY_VOXELS_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "shaders/shared/voxel_types.h"

#define NO_VOXEL 0xffffffffu

layout(set = 0, binding = 8, scalar) readonly buffer VoxelOccupancy { uint words[]; } voxelOccupancy;
layout(set = 0, binding = 9, scalar) readonly buffer VoxelRank { uint before[]; } voxelRank;
layout(set = 0, binding = 10, scalar) readonly buffer VoxelMaterials { VoxelMaterial data[]; } voxelMaterials;

uint voxelWord(VoxelGrid g, ivec3 voxel) {
    return (uint(voxel.z) * g.resolution.y + uint(voxel.y)) * g.wordsPerRow + (uint(voxel.x) >> 5);
}

bool insideGrid(VoxelGrid g, ivec3 voxel) {
    return all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, ivec3(g.resolution)));
}

// Number of an occupied voxel, or NO_VOXEL.
uint voxelNumber(VoxelGrid g, ivec3 voxel) {
    if (!insideGrid(g, voxel)) return NO_VOXEL;
    const uint word = voxelWord(g, voxel);
    const uint bits = voxelOccupancy.words[word];
    const uint bit = 1u << (uint(voxel.x) & 31u);
    if ((bits & bit) == 0u) return NO_VOXEL;
    return voxelRank.before[word] + uint(bitCount(bits & (bit - 1u)));
}

ivec3 voxelAt(VoxelGrid g, vec3 position) { return ivec3(floor((position - g.origin) / g.voxelSize)); }

#endif
