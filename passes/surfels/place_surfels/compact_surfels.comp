// Compacts the valid candidates: the unoccluded ones and, where they are asked for, the occluded ones with area 0.
// Their order is any, and nothing depends on it. ALL: all candidates are kept in place, for surfels that are indexed by id.
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer Candidates { Surfel data[]; } candidates;
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
buffer Count { uint value; } count;  // Of those that are valid.
layout(push_constant) uniform Push {
    uint candidateCount;
    uint includeOccluded;  // 0 or 1.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.candidateCount) return;
    const bool isOccluded = occluded.data[i] != 0u;
    const bool exists = rays.data[i].tMax >= 0.0 && (!isOccluded || push.includeOccluded == 1u);
    Surfel s = candidates.data[i];
    if (isOccluded) s.area = 0.0;
#ifdef ALL
    if (exists)
        atomicAdd(count.value, 1u);
    else
        s = Surfel(s.position, NO_VOXEL, vec3(0.0, 0.0, 1.0), VOXRAY_NO_SURFEL, vec3(0.0), 0u, 0.0);
    surfels.data[i] = s;
#else
    if (exists) surfels.data[atomicAdd(count.value, 1u)] = s;
#endif
}
