// Surfels that nothing hides from the one that began their voxel's new side are on it, too. A thread takes a surfel.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Occluded { uint data[]; } occluded;
layout(push_constant) uniform Push {
    uint first;
    uint count;
    uint round;
    uint isLast;     // 1: hidden or not.
    uint isCovered;  // Which surfels.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const PatchSurfel s = patchSurfels.data[push.first + i];
    if (s.side != NO_SIDE || s.isCovered != push.isCovered) return;
    if (push.isLast == 1u || occluded.data[i] == 0u) patchSurfels.data[push.first + i].side = push.round;
}
