// The first surfel without a group of each voxel becomes the seed of a new group.
#include "passes/clusters/grouped_surfels.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Lists { uvec2 data[]; } lists;  // By voxel: its first surfel, and the end.
writeonly buffer Seeds { uint data[]; } seeds;  // By voxel: a surfel.
buffer Remaining { uint count; } remaining;     // Voxels with a new seed.
layout(push_constant) uniform Push {
    uint voxels;
    uint round;
    uint groupsOccluded;  // 1: occluded surfels are grouped. 0: unoccluded ones.
} push;

void main() {
    const uint voxel = linearIndex();
    if (voxel >= push.voxels) return;
    for (uint i = lists.data[voxel].x; i < lists.data[voxel].y; ++i) {
        if (groupedSurfels.data[i].group != NO_GROUP || groupedSurfels.data[i].isOccluded != push.groupsOccluded) continue;
        groupedSurfels.data[i].group = push.round;
        seeds.data[voxel] = i;
        atomicAdd(remaining.count, 1u);
        return;
    }
}
