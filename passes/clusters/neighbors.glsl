// Neighbors of surface groups (VoxelPatches::neighbors): groups in the 26 voxels around that a group sees, a byte
// each, four in a word. Occluded groups have occluded neighbors, others have others.
//
//     bit 7         3   2       0
//        | voxel    | group    |
//
// The voxel is x + 3y + 9z, each of which is 0, 1 or 2 for -1, 0 and 1 voxels along an axis. Groups of a voxel are
// counted from its first one, occluded ones backwards from its last one.
#ifndef VOXRAY_GROUP_NEIGHBORS_GLSL
#define VOXRAY_GROUP_NEIGHBORS_GLSL

#include "passes/clusters/group_patches.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;  // Per voxel.
readonly buffer FirstGroup { uint data[]; } firstGroup;                     // Per voxel.

ivec3 neighborOffset(uint code) {
    const int voxel = int(code >> 3);
    return ivec3(voxel % 3, voxel / 3 % 3, voxel / 9) - 1;
}

// The byte of a neighbor with index `neighbor`.
uint neighborCode(SurfaceGroup group, SurfaceGroup neighborGroup, uint neighbor) {
    const uint voxel = neighborGroup.voxel;
    const uvec3 offset = coordinates.data[voxel] + 1u - coordinates.data[group.voxel];
    const uint inVoxel =
        isOccluded(group) ? firstGroup.data[voxel + 1u] - 1u - neighbor : neighbor - firstGroup.data[voxel];
    return (offset.x + 3u * offset.y + 9u * offset.z) << 3 | inVoxel;
}

// Index of the neighbor with a byte.
uint neighborIndex(VoxelGrid grid, SurfaceGroup group, uint code) {
    const uint voxel = voxelNumber(grid, ivec3(coordinates.data[group.voxel]) + neighborOffset(code));
    return isOccluded(group) ? firstGroup.data[voxel + 1u] - 1u - (code & 7u) : firstGroup.data[voxel] + (code & 7u);
}

// Byte i of a list, given its word i / 4.
uint byteOf(uint word, uint i) { return word >> 8u * (i % 4u) & 255u; }

#endif
