// Compacts the valid candidates: the unoccluded ones and, where they are asked for, the occluded ones with area 0.
// Their order is any, and nothing depends on it.
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
    uint includeOccluded;  // 0 or 1.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.candidateCount || rays.data[i].tMax < 0.0) return;
    const bool isOccluded = occluded.data[i] != 0u;
    if (isOccluded && push.includeOccluded == 0u) return;
    Surfel s = candidates.data[i];
    if (isOccluded) s.area = 0.0;
    surfels.data[atomicAdd(count.value, 1u)] = s;
}
