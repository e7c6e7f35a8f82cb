// Lists the cells of surface voxels, in the order of their numbers: the fragments that the octree is built from.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/octree_cells.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer FragmentCellsRef { LargeUints cells; };
layout(push_constant, scalar) uniform Push { VoxelGrid grid; } push;

void main() {
    const uint word = linearIndex(), perRow = push.grid.wordsPerRow;
    const uvec3 size = push.grid.resolution;
    if (word >= perRow * size.y * size.z) return;
    const ivec3 first = ivec3(32u * (word % perRow), word / perRow % size.y, word / (perRow * size.y));
    uint number = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u)
        cells.data[number++] = packCell(first + ivec3(findLSB(bits), 0, 0));
}
