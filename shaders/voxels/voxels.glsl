// Surface voxels: an occupancy bit for each voxel of the grid, and the number (rank) of an occupied voxel among these,
// which indexes all data of voxels. Empty space takes two bits per voxel.
#ifndef VOXRAY_VOXELS_GLSL
#define VOXRAY_VOXELS_GLSL

#include "shaders/voxels/small_areas.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/voxels/voxel_packing.h"

layout(scalar) readonly buffer VoxelOccupancy { uint words[]; } voxelOccupancy;
layout(scalar) readonly buffer VoxelRank { uint before[]; } voxelRank;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer VoxelMaterials { PackedVoxelMaterial data[]; };
layout(scalar) readonly buffer VoxelMaterialsRef { VoxelMaterials voxelMaterials; };

VoxelMaterial voxelMaterial(uint voxel) { return unpackMaterial(voxelMaterials.data[voxel]); }

// Unoccluded area of a voxel's surfaces at a face +x -x +y -y +z -z, in units of a voxel's face.
float unoccluded(VoxelMaterial m, uint face) {
    return (face & 1u) == 0u ? m.unoccludedPositive[face >> 1] : m.unoccludedNegative[face >> 1];
}

// Voxels of the grid's window along each axis.
uvec3 windowVoxels(VoxelGrid g) { return min(g.resolution, uvec3(g.windowSize)); }

bool insideGrid(VoxelGrid g, ivec3 voxel) {
    return all(greaterThanEqual(voxel, g.first)) && all(lessThan(voxel, g.first + ivec3(windowVoxels(g))));
}

// The occupancy word of a voxel of the window, and its bit in the word.
uint voxelWord(VoxelGrid g, ivec3 voxel) {
    const uvec3 wrapped = uvec3(voxel) & (g.windowSize - 1u);
    return g.firstWord + (wrapped.z * windowVoxels(g).y + wrapped.y) * g.wordsPerRow + (wrapped.x >> 5);
}
uint voxelBit(VoxelGrid g, ivec3 voxel) { return 1u << (uint(voxel.x) & (g.windowSize - 1u) & 31u); }

// The wrapped coordinates of the first voxel of an occupancy word of the grid, and the voxel with given wrapped coordinates.
uvec3 wordCoordinates(VoxelGrid g, uint word) {
    const uint row = word / g.wordsPerRow, rows = windowVoxels(g).y;
    return uvec3(32u * (word % g.wordsPerRow), row % rows, row / rows);
}
uvec3 unwrappedVoxel(VoxelGrid g, uvec3 wrapped) {
    return uvec3(g.first) + ((wrapped - uvec3(g.first)) & (g.windowSize - 1u));
}

bool isOccupied(VoxelGrid g, ivec3 voxel) {
    return insideGrid(g, voxel) && (voxelOccupancy.words[voxelWord(g, voxel)] & voxelBit(g, voxel)) != 0u;
}

// Number of an occupied voxel, or NO_VOXEL.
uint voxelNumber(VoxelGrid g, ivec3 voxel) {
    if (!insideGrid(g, voxel)) return NO_VOXEL;
    const uint word = voxelWord(g, voxel);
    const uint bits = voxelOccupancy.words[word];
    const uint bit = voxelBit(g, voxel);
    if ((bits & bit) == 0u) return NO_VOXEL;
    return voxelRank.before[word] + uint(bitCount(bits & (bit - 1u)));
}

ivec3 voxelAt(VoxelGrid g, vec3 position) { return ivec3(floor((position - g.origin) / g.voxelSize)); }

// Number of a surface point's voxel. Where rasterization left it empty (the surface lies between sample points), that
// of the nearest of the 26 adjacent voxels, so that no light is lost; NO_VOXEL where these are empty as well.
uint nearestVoxel(VoxelGrid g, vec3 position) {
    const ivec3 center = voxelAt(g, position);
    const uint number = voxelNumber(g, center);
    if (number != NO_VOXEL) return number;
    const vec3 coordinates = (position - g.origin) / g.voxelSize;
    uint nearest = NO_VOXEL;
    float best = 1.0e30;
    for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 1; ++x) {
                const ivec3 neighbor = center + ivec3(x, y, z);
                const vec3 offset = vec3(neighbor) + 0.5 - coordinates;
                if (dot(offset, offset) >= best) continue;
                const uint voxel = voxelNumber(g, neighbor);
                if (voxel == NO_VOXEL) continue;
                nearest = voxel;
                best = dot(offset, offset);
            }
    return nearest;
}

#endif
