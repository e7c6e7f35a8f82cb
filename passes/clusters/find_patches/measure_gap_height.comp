// Sets the height of visibility rays above occluded surfels to half of the gap in front of them.
#include "passes/clusters/find_patches/grouped_surfel.h"
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
    if (i >= push.count || hits.data[i].triangle == NO_HIT) return;
    groupedSurfels.data[push.first + i].height = 0.5 * hits.data[i].t;
}
