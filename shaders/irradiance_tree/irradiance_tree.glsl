// Lookups in an irradiance tree (docs/merged-voxels.md): light by face of voxels, one value for all voxels of a leaf.
#ifndef VOXRAY_IRRADIANCE_TREE_GLSL
#define VOXRAY_IRRADIANCE_TREE_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "shaders/compute/large_buffer.glsl"
#include "shaders/irradiance_tree/irradiance_tree_types.h"
#include "shaders/voxels/face.glsl"
#include "shaders/voxels/voxels.glsl"

layout(scalar) readonly buffer IrradianceTree {
    LargeUints words;
    IrradianceTreeGrid grid;
} irradianceTree;
// A byte a surface voxel, four in a word: a bit for each face that knows any light.
readonly buffer TreeFaces { uint bytes[]; } treeFaces;

// The leaf that a voxel lies in; what it says holds for faces that know any light.
TreeLeaf treeLeaf(uint root, ivec3 voxel) {
    uint at = root;
    uint word = irradianceTree.words.data[at];
    while (splitAxis(word) != TREE_LEAF) {
        at += voxel[splitAxis(word)] < int(splitPlane(word)) ? 1u : splitOffset(word);
        word = irradianceTree.words.data[at];
    }
    return unpackLeaf(word, irradianceTree.words.data[at + 1u]);
}

// Adds a voxel's irradiance times area for a normal, as addFaces() of shaders/voxels/face_irradiance.glsl does.
void addTreeFaces(ivec3 voxel, vec3 normal, inout vec3 sum, inout float area) {
    const VoxelGrid g = irradianceTree.grid.voxels;
    const uint number = voxelNumber(g, voxel);
    if (number == NO_VOXEL) return;
    const uint known = treeFaces.bytes[number / 4u] >> (8u * (number & 3u));
    const bool allAlike = g.directions == 1u;
    for (uint k = 0u; k < (allAlike ? 6u : 3u); ++k) {
        const uint face = allAlike ? k : faceOf(normal, k);
        const float weight = allAlike ? 1.0 : normal[k] * normal[k];
        if (weight < 1e-6 || (known >> face & 1u) == 0u) continue;
        const TreeLeaf leaf = treeLeaf(irradianceTree.grid.root[face], voxel);
        sum += weight * leaf.area * leaf.irradiance;
        area += weight * leaf.area;
    }
}

// As irradianceAt() of shaders/voxels/face_irradiance.glsl: irradiance at a point of a surface with unit normal `normal`; with
// under a twentieth of a voxel's face that looks the same way, the voxels around it are taken together. Where they know nothing
// either, it is black and `known` is false.
vec3 treeIrradianceAt(vec3 position, vec3 normal, out bool known) {
    const ivec3 voxel = voxelAt(irradianceTree.grid.voxels, position);
    vec3 sum = vec3(0.0);
    float area = 0.0;
    addTreeFaces(voxel, normal, sum, area);
    for (int i = 0; i < 27 && area < 0.05; ++i) {
        if (i == 13) continue;
        addTreeFaces(voxel + ivec3(i % 3, (i / 3) % 3, i / 9) - 1, normal, sum, area);
    }
    known = area > 0.0;
    return known ? sum / area : vec3(0.0);
}

#endif
