// A ray from each virtual light of a range through the center of each texel of its shadow map.
#include "passes/vpls/gather_vpls/hemi_octahedral.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer ActiveVpls { uint data[]; } activeVpls;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    uint firstVpl, vplCount;  // Range of the active lights.
    uint resolution;          // Texels along an edge.
} push;

void main() {
    const uint i = linearIndex(), texelsPerMap = push.resolution * push.resolution;
    if (i >= push.vplCount * texelsPerMap) return;
    const Vpl vpl = vpls.data[activeVpls.data[push.firstVpl + i / texelsPerMap]];
    const vec2 uv = (vec2(i % push.resolution, i % texelsPerMap / push.resolution) + 0.5) / float(push.resolution);
    rays.data[i] = Ray(vpl.position, 0.0, hemiOctahedralDirection(uv, vpl.normal), 1.0e30);
}
