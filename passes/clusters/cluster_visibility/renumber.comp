// The new numbers of sides whose voxels have not changed, and where the patches of each of these began. A thread takes a side.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
readonly buffer PreviousSides { uint data[]; } previousSides;
layout(scalar) readonly buffer Coordinates { uvec3 data[]; } coordinates;
readonly buffer Near { uint words[]; } near;  // A bit a voxel: where a ray that ends there may have met what has changed.
readonly buffer FirstPatches { uint data[]; } firstPatches;  // By previous side.
writeonly buffer NewSides { uint data[]; } newSides;         // By previous side; NO_SIDE before.
writeonly buffer BeganAt { uint data[]; } beganAt;           // By side: where its patches began; NO_SIDE: they are new.
layout(push_constant, scalar) uniform Push {
    VoxelGrid grid;
    uint sideCount;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.sideCount) return;
    const uint previous = previousSides.data[i];
    beganAt.data[i] = previous == NO_SIDE ? NO_SIDE : firstPatches.data[previous];
    const ivec3 voxel = ivec3(coordinates.data[sides.data[i].voxel]);
    if (previous != NO_SIDE && (near.words[voxelWord(push.grid, voxel)] & voxelBit(push.grid, voxel)) == 0u) newSides.data[previous] = i;
}
