// Volumes of one RGBA8 word per voxel, as published in Magalhães 2020: of all voxels of the grid; empty ones hold 0.
// Host: passes/published/magalhaes_2020/packed_voxels.h.
#ifndef VOXRAY_PACKED_VOXELS_GLSL
#define VOXRAY_PACKED_VOXELS_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "shaders/voxels/voxel_types.h"

// Index of a voxel's word; outside of the grid, of the nearest voxel.
uint packedIndex(VoxelGrid g, ivec3 voxel) {
    const uvec3 inside = uvec3(clamp(voxel, ivec3(0), ivec3(g.resolution) - 1));
    return (inside.z * g.resolution.y + inside.y) * g.resolution.x + inside.x;
}

// In units of voxels: voxel (x, y, z) spans [x, x + 1] and so on.
vec3 voxelCoordinates(VoxelGrid g, vec3 position) { return (position - g.origin) / g.voxelSize; }

// The color in a word, 0 to 1.
vec3 packedColor(uint word) { return unpackUnorm4x8(word).rgb; }

// A normal as a color, and back (section 4.2.5.1). Means of normals are not normalized.
vec3 colorOfNormal(vec3 normal) { return 0.5 * normal + 0.5; }
vec3 normalOfColor(vec3 color) { return 2.0 * color - 1.0; }

#endif
