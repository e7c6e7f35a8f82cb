// Marks the voxel faces that have surfels: those alone can be lit.
#include "shaders/voxels/face.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
buffer Measured { uint data[]; } measured;  // A bit a face, by voxel.
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.area == 0.0) return;  // Covered: no voxel's.
    const uint faces = faceBits(s.normal);
    if ((measured.data[s.voxel] & faces) != faces) atomicOr(measured.data[s.voxel], faces);
}
