// Evaluates a range of the surfels of patches. CLEARANCE: generates rays from occluded ones to the surface in front.
#include "passes/clusters/cluster_visibility/patch_surfel.h"
#include "passes/surfels/occlusion_ray.glsl"
#include "passes/surfels/surfel_points.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer SurfelIdsRef { LargeUints surfelIds; };
#ifdef CLEARANCE
layout(scalar) readonly buffer SidesRef { LargeUints sides; };
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
#endif
layout(push_constant) uniform Push {
    uint first;
    uint count;
    uint pointSeed;
    float voxelSize;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint id = surfelIds.data[push.first + i];
    const SurfelGeometry s = surfelGeometry(id, push.pointSeed);
    patchSurfels.data[push.first + i] = PatchSurfel(s.position, id, s.normal, 0.5 * push.voxelSize);
#ifdef CLEARANCE
    const bool isOccluded = sideOf(sides.data[id / SURFELS_PER_WORD], id) == SURFEL_OCCLUDED;
    rays.data[i] = isOccluded ? occlusionRay(s.position, s.normal, push.voxelSize) : kNoRay;
#endif
}
