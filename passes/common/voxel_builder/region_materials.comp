#version 460
#extension GL_GOOGLE_include_directive : require
// The materials of voxels whose region was made anew, under their new numbers: of fresh voxels the fresh ones, of all others the
// previous ones. A thread takes a word.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) readonly buffer Fresh { uint words[]; } fresh;
layout(set = 0, binding = 1) readonly buffer FreshRank { uint before[]; } freshRank;
layout(set = 0, binding = 2, scalar) readonly buffer FreshMaterialsAt { VoxelMaterials freshMaterials; };
layout(set = 0, binding = 3) readonly buffer Previous { uint words[]; } previous;
layout(set = 0, binding = 4) readonly buffer PreviousRank { uint before[]; } previousRank;
layout(set = 0, binding = 5, scalar) readonly buffer PreviousMaterialsAt { VoxelMaterials previousMaterials; };
layout(push_constant) uniform Push { uint words; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint freshBits = fresh.words[word], previousBits = previous.words[word];
    uint number = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u) {
        const uint bit = bits & -bits, below = bit - 1u;
        if ((freshBits & bit) != 0u)
            voxelMaterials.data[number] = freshMaterials.data[freshRank.before[word] + uint(bitCount(freshBits & below))];
        else
            voxelMaterials.data[number] = previousMaterials.data[previousRank.before[word] + uint(bitCount(previousBits & below))];
        ++number;
    }
}
