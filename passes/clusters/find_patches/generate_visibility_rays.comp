// Generates visibility rays from each surfel without a group to the seed of its voxel's new group.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

readonly buffer Seeds { uint data[]; } seeds;  // Surfel of each voxel.
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint first;
    uint count;
    uint groupsOccluded;  // 1: only occluded surfels are grouped. 0: only unoccluded ones.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Ray ray = kNoRay;
    const GroupedSurfel s = groupedSurfels.data[push.first + i];
    if (s.group == NO_GROUP && s.isOccluded == push.groupsOccluded) {
        const vec3 origin = pointAbove(s);
        const vec3 toSeed = pointAbove(groupedSurfels.data[seeds.data[s.voxel]]) - origin;
        if (dot(toSeed, toSeed) > 0.0) ray = Ray(origin, 0.0, normalize(toSeed), length(toSeed));
    }
    rays.data[i] = ray;
}
