// From above each surfel that is on no side yet to above the one that began its voxel's new side. A thread takes a surfel.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

readonly buffer Pivots { uint data[]; } pivots;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint first;
    uint count;
    uint isCovered;  // Which surfels.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Ray ray = kNoRay;
    const PatchSurfel s = patchSurfels.data[push.first + i];
    if (s.side == NO_SIDE && s.isCovered == push.isCovered) {
        const vec3 from = raisedOver(s);
        const vec3 way = raisedOver(patchSurfels.data[pivots.data[s.voxel]]) - from;
        if (dot(way, way) > 0.0) ray = Ray(from, 0.0, normalize(way), length(way));
    }
    rays.data[i] = ray;
}
