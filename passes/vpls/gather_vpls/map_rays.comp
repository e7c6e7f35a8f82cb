// A ray from each virtual light of a run through the center of each texel of its shadow map.
#include "passes/vpls/gather_vpls/hemisphere.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    uint firstVpl, vplCount;  // Of the list.
    uint resolution;          // Texels a side.
} push;

void main() {
    const uint i = linearIndex(), perMap = push.resolution * push.resolution;
    if (i >= push.vplCount * perMap) return;
    const Vpl vpl = vpls.data[list.data[push.firstVpl + i / perMap]];
    const vec2 place = (vec2(i % push.resolution, i % perMap / push.resolution) + 0.5) / float(push.resolution);
    rays.data[i] = Ray(vpl.position, 0.0, hemisphereDirection(place, vpl.faceNormal), 1.0e30);
}
