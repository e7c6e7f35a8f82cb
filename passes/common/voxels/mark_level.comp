// Occupancy of a level among that of all levels: the voxels that it holds, without those that the finer level holds.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxel_levels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Window { uint words[]; } window;  // Occupancy of the level's whole window.
layout(scalar) writeonly buffer Joined { uint words[]; } joined;
layout(push_constant) uniform Push {
    uint level;
    uint words;
} push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const VoxelGrid grid = voxelLevels.data[push.level].grid;
    const uvec3 first = wordCoordinates(grid, word);
    uint kept = 0u;
    for (uint bits = window.words[word]; bits != 0u; bits &= bits - 1u) {
        const ivec3 voxel = ivec3(unwrappedVoxel(grid, first + uvec3(findLSB(bits), 0u, 0u)));
        const bool isFiner = push.level > 0u && isHeld(push.level - 1u, 2 * voxel);
        if (isHeld(push.level, voxel) && !isFiner) kept |= bits & -bits;
    }
    joined.words[grid.firstWord + word] = kept;
}
