// Picks the surfels whose voxel faces are asked for. Their order is any; nothing depends on it.
#include "shaders/voxels/face.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
readonly buffer Asked { uint data[]; } asked;  // A bit a face, by voxel.
layout(scalar) writeonly buffer Selected { Surfel data[]; } selected;
buffer SelectedCount { uint value; } selectedCount;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count || surfels.data[i].area == 0.0) return;  // Covered ones light no voxel.
    const uint bits = asked.data[surfels.data[i].voxel];
    if (bits == 0u) return;
    const vec3 normal = surfels.data[i].normal;
    const uint faces = faceBits(normal);
    if ((bits & faces) != 0u) selected.data[atomicAdd(selectedCount.value, 1u)] = surfels.data[i];
}
