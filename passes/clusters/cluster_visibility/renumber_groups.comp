// For an update: the new numbers of surface groups whose voxels have not changed, and the first patch that each had before.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer PreviousGroups { uint data[]; } previousGroups;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
readonly buffer NearChange { uint words[]; } nearChange;     // A bit a voxel: so close to a change that hits there may have changed.
readonly buffer FirstPatches { uint data[]; } firstPatches;  // By previous group.
writeonly buffer NewGroups { uint data[]; } newGroups;       // By previous group; NO_GROUP before.
writeonly buffer PreviousFirstPatches { uint data[]; } previousFirstPatches;  // By group; NO_GROUP: its patches are new.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint groupCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.groupCount) return;
    const uint previous = previousGroups.data[i];
    previousFirstPatches.data[i] = previous == NO_GROUP ? NO_GROUP : firstPatches.data[previous];
    const ivec3 voxel = ivec3(coordinates.data[groups.data[i].voxel]);
    const bool isNearChange = (nearChange.words[voxelWord(push.grid, voxel)] & voxelBit(push.grid, voxel)) != 0u;
    if (previous != NO_GROUP && !isNearChange) newGroups.data[previous] = i;
}
