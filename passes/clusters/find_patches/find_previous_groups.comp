// Finds the index that each surface group of an unchanged voxel had in the previous build. Where no adjacent voxel has
// changed either, a later shader reuses the earlier visibility tests between the group and its neighbors.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
readonly buffer Changed { uint words[]; } changed;  // A bit for each voxel.
// A bit for each voxel: set if it or one of the 26 around it has changed.
readonly buffer ChangedNeighborhood { uint words[]; } changedNeighborhood;
readonly buffer PreviousOccupancy { uint words[]; } previousOccupancy;
readonly buffer PreviousRank { uint before[]; } previousRank;
readonly buffer PreviousFirstGroup { uint data[]; } previousFirstGroup;
writeonly buffer PreviousGroupIndex { uint data[]; } previousGroupIndex;  // NO_GROUP: the voxel has changed.
// As previousGroupIndex, but NO_GROUP also if an adjacent voxel has changed.
writeonly buffer ReusablePreviousIndex { uint data[]; } reusablePreviousIndex;
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint groupCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.groupCount) return;
    const uint voxel = groups.data[i].voxel;
    const ivec3 coordinate = ivec3(coordinates.data[voxel]);
    const uint word = voxelWord(push.grid, coordinate), bit = voxelBit(push.grid, coordinate);
    uint previous = NO_GROUP;
    if ((changed.words[word] & bit) == 0u) {
        const uint previousVoxel =
            previousRank.before[word] + uint(bitCount(previousOccupancy.words[word] & (bit - 1u)));
        previous = previousFirstGroup.data[previousVoxel] + i - firstGroup.data[voxel];
    }
    previousGroupIndex.data[i] = previous;
    reusablePreviousIndex.data[i] = (changedNeighborhood.words[word] & bit) == 0u ? previous : NO_GROUP;
}
