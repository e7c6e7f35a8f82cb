// The coordinates of each surface voxel, by the voxel's number.
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
    const uint row = word / push.grid.wordsPerRow, rows = heldVoxels(push.grid).y;
    const uvec3 slot = uvec3(32u * (word % push.grid.wordsPerRow), row % rows, row / rows);
    uint voxel = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u)
        voxelCoordinates.data[voxel++] = voxelInSlot(push.grid, slot + uvec3(findLSB(bits), 0u, 0u));
}
