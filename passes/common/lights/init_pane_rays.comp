// Copies rays to search for panes along them. AT_HITS: they end at their hits.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer PaneRays { Ray data[]; } paneRays;
#ifdef AT_HITS
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
#endif
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Ray ray = rays.data[i];
#ifdef AT_HITS
    if (ray.tMax >= ray.tMin && hits.data[i].triangle != NO_HIT) ray.tMax = hits.data[i].t;
#endif
    paneRays.data[i] = ray;
}
