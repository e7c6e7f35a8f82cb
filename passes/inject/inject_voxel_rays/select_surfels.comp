// Compacts the unoccluded surfels on hit faces. Their order is any, and nothing depends on it.
#include "shaders/voxels/face.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
readonly buffer HitFaces { uint data[]; } hitFaces;  // One bit per face, by voxel.
layout(scalar) writeonly buffer Selected { Surfel data[]; } selected;
buffer SelectedCount { uint value; } selectedCount;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count || surfels.data[i].area == 0.0) return;
    const uint faces = hitFaces.data[surfels.data[i].voxel];
    if (faces == 0u || (faces & faceBits(surfels.data[i].normal)) == 0u) return;
    selected.data[atomicAdd(selectedCount.value, 1u)] = surfels.data[i];
}
