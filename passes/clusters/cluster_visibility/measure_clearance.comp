// Sets the height above occluded surfels to half of their clearance, the distance to the surface in front of them.
#include "passes/clusters/cluster_visibility/patch_surfel.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count && hits.data[i].triangle != NO_HIT)
        patchSurfels.data[push.first + i].height = 0.5 * hits.data[i].t;
}
