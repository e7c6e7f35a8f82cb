// Lists the packed coordinates of surface voxels, by number: the fragments that the octree is built from.
#include "shaders/compute/linear_index.glsl"
#include "shaders/octree/octree_cells.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer FragmentCellsRef { LargeUints cells; };
layout(push_constant, scalar) uniform Push { VoxelGrid grid; } push;

void main() {
    const uint word = linearIndex();
    if (word >= push.grid.wordsPerRow * push.grid.resolution.y * push.grid.resolution.z) return;
    const ivec3 first = ivec3(wordCoordinates(push.grid, word));
    uint number = voxelRank.before[word];
    for (uint bits = voxelOccupancy.words[word]; bits != 0u; bits &= bits - 1u)
        cells.data[number++] = packCell(first + ivec3(findLSB(bits), 0, 0));
}
