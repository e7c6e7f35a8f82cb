// Keeps the candidates that have open space before them and, where all sides are asked for, those that have not, as covered ones:
// they stand for no area. Their order is any; nothing depends on it.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer Candidates { Surfel data[]; } candidates;
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
buffer Count { uint value; } count;
layout(push_constant) uniform Push {
    uint candidateCount;
    uint keepCovered;  // 0 or 1.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.candidateCount || rays.data[i].tMax < 0.0) return;
    const bool covered = occluded.data[i] != 0u;
    if (covered && push.keepCovered == 0u) return;
    Surfel s = candidates.data[i];
    if (covered) s.area = 0.0;
    surfels.data[atomicAdd(count.value, 1u)] = s;
}
