// The open sides in voxels. Their order is any; nothing depends on it. A thread takes a voxel.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Found { uint data[]; } found;
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
writeonly buffer Reached { uint data[]; } reached;
writeonly buffer Listed { uint data[]; } listed;
buffer Count { uint value; } count;
layout(push_constant) uniform Push { uint voxels; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.voxels) return;
    const uint voxel = found.data[i];
    for (uint side = firstSide.data[voxel]; side < firstSide.data[voxel + 1u]; ++side) {
        if (sides.data[side].isCovered == 1u) continue;
        reached.data[side] = 1u;
        listed.data[atomicAdd(count.value, 1u)] = side;
    }
}
