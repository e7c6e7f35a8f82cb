// The words of an irradiance tree, shared by C++ (passes/final_gather/merged_voxels/) and GLSL
// (irradiance_tree.glsl).
#ifndef VOXRAY_SHARED_IRRADIANCE_TREE_TYPES_H
#define VOXRAY_SHARED_IRRADIANCE_TREE_TYPES_H

#include "shaders/voxels/voxel_packing.h"

VOXRAY_SHARED_BEGIN

// A node that splits is one word: the axis, the first voxel along it that lies behind the split, and how many
// words on the child behind the split stands; the child before it is the next word. A leaf is two words.
#define TREE_LEAF 3u  // In place of an axis.
#define TREE_LEAF_WORDS 2u
#define TREE_MAX_SPLIT 0x3ffu
#define TREE_MAX_OFFSET 0xfffffu

// The light of a region of voxels, at one of their faces: means of the voxels where that face knows any.
struct TreeLeaf {
    vec3 irradiance;  // W/m²: flux over area, of all of them together.
    float area;       // In units of a voxel's face.
};

// The grid whose voxels were merged, and the root of each face's tree: +x -x +y -y +z -z.
struct IrradianceTreeGrid {
    VoxelGrid voxels;
    uint root[6];
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

// Areas lose their last bit.
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
