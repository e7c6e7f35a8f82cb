// Lists the coordinates of surface voxels, by number.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer VoxelCoordinates { uvec3 data[]; } voxelCoordinates;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint words;
} push;

void main() {
    const uint word = linearIndex();
    if (word >= push.words) return;
    const uvec3 first = wordCoordinates(push.grid, word);
    uint voxel = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u)
        voxelCoordinates.data[voxel++] = unwrappedVoxel(push.grid, first + uvec3(findLSB(bits), 0u, 0u));
}
