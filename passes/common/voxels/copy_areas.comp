// Copies the unoccluded areas of a level's voxels to their numbers among those of all levels.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxel_levels.glsl"
layout(local_size_x = 64) in;

// Of the level's whole window.
layout(scalar) readonly buffer Window { uint words[]; } window;
layout(scalar) readonly buffer WindowRank { uint before[]; } windowRank;
layout(scalar) readonly buffer WindowMaterialsRef { VoxelMaterials windowMaterials; };
layout(scalar) writeonly buffer Area { uint data[]; } area;
layout(push_constant) uniform Push {
    uint level;
    uint words;
} push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uint joined = voxelLevels.data[push.level].grid.firstWord + word;
    uint voxel = voxelRank.before[joined];
    for (uint bits = voxelOccupancy.words[joined]; bits != 0u; bits &= bits - 1u) {
        const uint lower = (bits & -bits) - 1u;
        const VoxelMaterial m =
            unpackMaterial(windowMaterials.data[windowRank.before[word] + uint(bitCount(window.words[word] & lower))]);
        for (uint axis = 0u; axis < 3u; ++axis)
            area.data[3u * voxel + axis] =
                packPair(packArea(m.unoccludedPositive[axis]), packArea(m.unoccludedNegative[axis]));
        ++voxel;
    }
}
