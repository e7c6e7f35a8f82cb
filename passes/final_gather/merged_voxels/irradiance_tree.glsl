// Lookups in an irradiance tree (docs/merged-voxels.md): a leaf holds one irradiance for the faces of all its voxels.
#ifndef VOXRAY_IRRADIANCE_TREE_GLSL
#define VOXRAY_IRRADIANCE_TREE_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "passes/final_gather/merged_voxels/irradiance_tree_types.h"

layout(scalar) readonly buffer IrradianceTree {
    LargeUints words;
    IrradianceTreeGrid grid;
} irradianceTree;
// A byte per surface voxel, four in a word: a bit for each face that has a value.
readonly buffer TreeFaces { uint bytes[]; } treeFaces;

// The leaf that contains a voxel, by descent from a root; its value is for faces with their bit in treeFaces. The
// descent splits at each plane between voxels at most once.
TreeLeaf treeLeaf(uint root, ivec3 voxel) {
    uint index = root;
    uint word = irradianceTree.words.data[index];
    for (uint depth = 0u; depth < 3u * TREE_MAX_SPLIT && splitAxis(word) != TREE_LEAF; ++depth) {
        index += voxel[splitAxis(word)] < int(splitPlane(word)) ? 1u : splitOffset(word);
        word = irradianceTree.words.data[index];
    }
    return unpackLeaf(word, irradianceTree.words.data[index + 1u]);
}

// For face_lookup.glsl: irradiance, W/m², and area in voxel faces, 0 where the face has no value.
vec4 faceLight(uint number, ivec3 voxel, uint face) {
    const uint valid = treeFaces.bytes[number / 4u] >> (8u * (number & 3u));
    if ((valid >> face & 1u) == 0u) return vec4(0.0);
    const TreeLeaf leaf = treeLeaf(irradianceTree.grid.root[face], voxel);
    return vec4(leaf.irradiance, leaf.area);
}

#include "shaders/voxels/face_lookup.glsl"

#endif
