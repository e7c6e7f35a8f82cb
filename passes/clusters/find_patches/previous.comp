// The number that each side had in the last build, where its voxel has not changed; where none next to it has either, what hid its
// neighbours holds, too. A thread takes a side.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
readonly buffer Changed { uint words[]; } changed;  // A bit a voxel.
readonly buffer Near { uint words[]; } near;        // Likewise, one farther.
readonly buffer OccupancyBefore { uint words[]; } occupancyBefore;
readonly buffer RankBefore { uint before[]; } rankBefore;
readonly buffer FirstSideBefore { uint data[]; } firstSideBefore;
writeonly buffer PreviousSides { uint data[]; } previousSides;
writeonly buffer PairsFrom { uint data[]; } pairsFrom;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint sideCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.sideCount) return;
    const uint voxel = sides.data[i].voxel;
    const ivec3 at = ivec3(coordinates.data[voxel]);
    const uint word = voxelWord(push.grid, at), bit = voxelBit(push.grid, at);
    uint previous = NO_SIDE;
    if ((changed.words[word] & bit) == 0u) {
        const uint before = rankBefore.before[word] + uint(bitCount(occupancyBefore.words[word] & (bit - 1u)));
        previous = firstSideBefore.data[before] + i - firstSide.data[voxel];
    }
    previousSides.data[i] = previous;
    pairsFrom.data[i] = (near.words[word] & bit) == 0u ? previous : NO_SIDE;
}
