// Scatters surfels into the ranges of their voxels, in any order; sort_voxel_surfels.comp then orders each range.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/sorted_surfels.h"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SortedSurfels { SortedSurfel data[]; };
layout(scalar) readonly buffer SortedRef { SortedSurfels sorted; };
buffer Ends { uint data[]; } ends;  // Initially where a voxel's range begins, finally where it ends.
layout(push_constant) uniform Push {
    uint count;
    uint firstIndex;  // Of the chunk's surfels among all.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.voxel == NO_VOXEL) return;
    sorted.data[atomicAdd(ends.data[s.voxel], 1u)] =
        SortedSurfel(s.position, push.firstIndex + i, s.normal, s.id | (s.area == 0.0 ? VOXRAY_OCCLUDED : 0u));
}
