// Marks the voxel faces that have surfels.
#include "shaders/voxels/face.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
buffer FacesWithSurfels { uint data[]; } facesWithSurfels;  // One bit per face, by voxel.
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.area == 0.0) return;  // Occluded.
    const uint faces = faceBits(s.normal);
    if ((facesWithSurfels.data[s.voxel] & faces) != faces) atomicOr(facesWithSurfels.data[s.voxel], faces);
}
