// The words of an irradiance tree, shared by C++ (passes/final_gather/merged_voxels/) and GLSL
// (irradiance_tree.glsl).
#ifndef VOXRAY_SHARED_IRRADIANCE_TREE_TYPES_H
#define VOXRAY_SHARED_IRRADIANCE_TREE_TYPES_H

#include "shaders/voxels/voxel_packing.h"

VOXRAY_SHARED_BEGIN

// An inner node is one word: the axis of its split, the first voxel behind the splitting plane, and the
// offset in words to the child behind the plane; the child before it is the next word. A leaf is two words.
#define TREE_LEAF 3u  // Instead of an axis.
#define TREE_MAX_SPLIT 0x3ffu
#define TREE_MAX_OFFSET 0xfffffu

// The mean over the voxels of a leaf whose face has a value.
struct TreeLeaf {
    vec3 irradiance;  // W/m²: total flux over total area.
    float area;       // In units of a voxel's face.
};

struct IrradianceTreeGrid {
    VoxelGrid voxels;  // Whose voxels are merged.
    uint root[6];      // Root of each face's tree: +x -x +y -y +z -z.
};

VOXRAY_SHARED_FUNCTION uint packSplit(uint axis, uint split, uint offset) {
    return axis | (split << 2) | (offset << 12);
}
VOXRAY_SHARED_FUNCTION uint splitAxis(uint word) {
    return word & 3u;
}
VOXRAY_SHARED_FUNCTION uint splitPlane(uint word) {
    return (word >> 2) & TREE_MAX_SPLIT;
}
VOXRAY_SHARED_FUNCTION uint splitOffset(uint word) {
    return word >> 12;
}

// Areas lose their lowest bit.
VOXRAY_SHARED_FUNCTION uvec2 packLeaf(TreeLeaf leaf) {
    const uvec2 rgb = packRgb(leaf.irradiance);
    const uint area = (packArea(leaf.area) + 1u) >> 1;
    return uvec2(TREE_LEAF | (area << 2) | (rgb.y << 17), rgb.x);
}
VOXRAY_SHARED_FUNCTION TreeLeaf unpackLeaf(uint first, uint second) {
    TreeLeaf leaf;
    leaf.irradiance = unpackRgb(uvec2(second, first >> 17));
    leaf.area = unpackArea(((first >> 2) & 0x7fffu) << 1);
    return leaf;
}

VOXRAY_SHARED_END

#endif
