// For an update: maps surface groups of unchanged voxels from their previous index to the new one, and stores the first
// patch that each had in the previous build.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer PreviousGroupIndex { uint data[]; } previousGroupIndex;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
// A bit for each voxel in which hits may have changed.
readonly buffer ChangedNeighborhood { uint words[]; } changedNeighborhood;
readonly buffer FirstPatches { uint data[]; } firstPatches;  // Per previous group.
writeonly buffer NewGroupIndex { uint data[]; } newGroupIndex;       // Per previous group. Must be NO_GROUP before.
writeonly buffer PreviousFirstPatches { uint data[]; } previousFirstPatches;  // Per group; NO_GROUP: it is new.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint groupCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.groupCount) return;
    const uint previous = previousGroupIndex.data[i];
    previousFirstPatches.data[i] = previous == NO_GROUP ? NO_GROUP : firstPatches.data[previous];
    const ivec3 voxel = ivec3(coordinates.data[groups.data[i].voxel]);
    const uint changed = changedNeighborhood.words[voxelWord(push.grid, voxel)] & voxelBit(push.grid, voxel);
    if (previous != NO_GROUP && changed == 0u) newGroupIndex.data[previous] = i;
}
