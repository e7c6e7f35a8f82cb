// Counts the surfels of each voxel.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
#include "shaders/voxels/voxel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
buffer Counts { uint data[]; } counts;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint voxel = surfels.data[i].voxel;
    if (voxel != NO_VOXEL) atomicAdd(counts.data[voxel], 1u);
}
