// From each covered surfel on no side yet across the gap that it is in. A thread takes a surfel.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/open_space.glsl"
layout(local_size_x = 64) in;

layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint first;
    uint count;
    float voxelSize;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const PatchSurfel s = patchSurfels.data[push.first + i];
    rays.data[i] = s.isCovered == 1u && s.side == NO_SIDE ? openSpaceRay(s.position, s.normal, push.voxelSize) : kNoRay;
}
