// The sides in each voxel, and where each surfel is. A thread takes a voxel.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Lists { uvec2 data[]; } lists;
readonly buffer FirstSide { uint data[]; } firstSide;
layout(scalar) readonly buffer PlacesAt { LargeUints places; };
layout(scalar) writeonly buffer Sides { SurfaceSide data[]; } sides;
layout(push_constant) uniform Push { uint voxels; } push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    const uint end = lists.data[voxel].y;
    uint i = lists.data[voxel].x;
    for (uint side = firstSide.data[voxel]; side < firstSide.data[voxel + 1u]; ++side) {
        const uint first = i, own = patchSurfels.data[i].side;
        for (; i < end && patchSurfels.data[i].side == own; ++i) {
            patchSurfels.data[i].side = side;
            places.data[patchSurfels.data[i].number] = i;
        }
        const PatchSurfel s = patchSurfels.data[first];
        sides.data[side] = SurfaceSide(raisedOver(s), voxel, first, i - first, s.isCovered, 0u, 0u);
    }
}
