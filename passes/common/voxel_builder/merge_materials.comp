// Copies materials to the numbers of voxels after a rebuilt region was merged: those of rebuilt voxels, and the
// previous ones of all others.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

readonly buffer Rebuilt { uint words[]; } rebuilt;
readonly buffer RebuiltRank { uint before[]; } rebuiltRank;
layout(scalar) readonly buffer RebuiltMaterialsRef { VoxelMaterials rebuiltMaterials; };
readonly buffer Previous { uint words[]; } previous;
readonly buffer PreviousRank { uint before[]; } previousRank;
layout(scalar) readonly buffer PreviousMaterialsRef { VoxelMaterials previousMaterials; };
layout(push_constant) uniform Push { uint words; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint rebuiltBits = rebuilt.words[word], previousBits = previous.words[word];
    uint number = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u) {
        const uint bit = bits & -bits, lower = bit - 1u;
        if ((rebuiltBits & bit) != 0u)
            voxelMaterials.data[number] =
                rebuiltMaterials.data[rebuiltRank.before[word] + uint(bitCount(rebuiltBits & lower))];
        else
            voxelMaterials.data[number] =
                previousMaterials.data[previousRank.before[word] + uint(bitCount(previousBits & lower))];
        ++number;
    }
}
