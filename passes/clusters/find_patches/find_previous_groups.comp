// Finds the index that each surface group of an unchanged voxel had in the previous build. Where no adjacent voxel has
// changed either, the occlusion between the group and its neighbours is reused.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstGroup { uint data[]; } firstGroup;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
readonly buffer Changed { uint words[]; } changed;  // A bit for each voxel.
readonly buffer ChangedNeighbourhood { uint words[]; } changedNeighbourhood;  // Likewise: it or an adjacent voxel.
readonly buffer PreviousOccupancy { uint words[]; } previousOccupancy;
readonly buffer PreviousRank { uint before[]; } previousRank;
readonly buffer PreviousFirstGroup { uint data[]; } previousFirstGroup;
writeonly buffer PreviousGroups { uint data[]; } previousGroups;  // NO_GROUP: its voxel has changed.
writeonly buffer ReusedGroup { uint data[]; } reusedGroup;  // The same, or NO_GROUP if an adjacent voxel has changed.
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
    previousGroups.data[i] = previous;
    reusedGroup.data[i] = (changedNeighbourhood.words[word] & bit) == 0u ? previous : NO_GROUP;
}
