// Lookups in an irradiance tree (docs/merged-voxels.md): light by face of voxels, one value for all voxels of a leaf.
#ifndef VOXRAY_IRRADIANCE_TREE_GLSL
#define VOXRAY_IRRADIANCE_TREE_GLSL


#include "shaders/compute/large_buffer.glsl"
#include "passes/final_gather/merged_voxels/irradiance_tree_types.h"

layout(scalar) readonly buffer IrradianceTree {
    LargeUints words;
    IrradianceTreeGrid grid;
} irradianceTree;
// A byte a surface voxel, four in a word: a bit for each face that knows any light.
readonly buffer TreeFaces { uint bytes[]; } treeFaces;

// The leaf that a voxel lies in; what it says holds for faces that know any light. A path from a root crosses each plane between
// voxels once at most.
TreeLeaf treeLeaf(uint root, ivec3 voxel) {
    uint at = root;
    uint word = irradianceTree.words.data[at];
    for (uint depth = 0u; depth < 3u * TREE_MAX_SPLIT && splitAxis(word) != TREE_LEAF; ++depth) {
        at += voxel[splitAxis(word)] < int(splitPlane(word)) ? 1u : splitOffset(word);
        word = irradianceTree.words.data[at];
    }
    return unpackLeaf(word, irradianceTree.words.data[at + 1u]);
}

vec4 faceLight(uint number, ivec3 voxel, uint face) {
    const uint known = treeFaces.bytes[number / 4u] >> (8u * (number & 3u));
    if ((known >> face & 1u) == 0u) return vec4(0.0);
    const TreeLeaf leaf = treeLeaf(irradianceTree.grid.root[face], voxel);
    return vec4(leaf.irradiance, leaf.area);
}

#include "shaders/voxels/face_lookup.glsl"

#endif
