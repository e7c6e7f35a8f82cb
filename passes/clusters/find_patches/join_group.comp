// Assigns surfels that see the seed of their voxel's new group to that group.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Occluded { uint data[]; } occluded;  // Results of the rays to the seeds.
layout(push_constant) uniform Push {
    uint first;
    uint count;
    uint round;
    uint isLast;          // 1: all remaining surfels join.
    uint groupsOccluded;  // 1: only occluded surfels are grouped. 0: only unoccluded ones.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const GroupedSurfel s = groupedSurfels.data[push.first + i];
    if (s.group != NO_GROUP || s.isOccluded != push.groupsOccluded) return;
    if (push.isLast == 1u || occluded.data[i] == 0u) groupedSurfels.data[push.first + i].group = push.round;
}
