// From the open space before each side to that before a side next to it. KEEP: not where it is known what lies between. A thread takes
// such a pair.
#include "passes/clusters/patches.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Sides { SurfaceSide data[]; } sides;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
layout(scalar) readonly buffer WhoseAt { LargeUints whose; };
#ifdef KEEP
readonly buffer PairsFrom { uint data[]; } pairsFrom;
#endif
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint side = whose.data[push.first + i];
#ifdef KEEP
    if (pairsFrom.data[side] != NO_SIDE) {
        rays.data[i] = kNoRay;
        return;
    }
#endif
    const vec3 from = sides.data[side].raised;
    const vec3 way = sides.data[neighbours.data[push.first + i]].raised - from;
    rays.data[i] = dot(way, way) > 0.0 ? Ray(from, 0.0, normalize(way), length(way)) : kNoRay;
}
