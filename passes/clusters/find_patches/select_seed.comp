// Makes the first surfel of each voxel that has no group the seed of a new group.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer SurfelRanges { uvec2 data[]; } surfelRanges;  // First and end surfel of each voxel.
writeonly buffer Seeds { uint data[]; } seeds;  // Surfel of each voxel.
buffer Remaining { uint count; } remaining;     // Number of voxels with a new seed.
layout(push_constant) uniform Push {
    uint voxelCount;
    uint round;
    uint groupsOccluded;  // 1: only occluded surfels are grouped. 0: only unoccluded ones.
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxelCount) return;
    for (uint i = surfelRanges.data[voxel].x; i < surfelRanges.data[voxel].y; ++i) {
        const GroupedSurfel s = groupedSurfels.data[i];
        if (s.group != NO_GROUP || s.isOccluded != push.groupsOccluded) continue;
        groupedSurfels.data[i].group = push.round;
        seeds.data[voxel] = i;
        atomicAdd(remaining.count, 1u);
        return;
    }
}
