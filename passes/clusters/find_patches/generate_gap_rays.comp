// Generates rays from occluded surfels without a group across the gap in front of them.
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/occlusion_ray.glsl"
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
    const GroupedSurfel s = groupedSurfels.data[push.first + i];
    rays.data[i] =
        s.isOccluded == 1u && s.group == NO_GROUP ? occlusionRay(s.position, s.normal, push.voxelSize) : kNoRay;
}
