// Counts the gather rays that read each face.
#include "passes/cache/hit_faces/hit_face.glsl"
#include "passes/cache/hit_faces/kept/kept_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer HitFaces { uint data[]; } hitFaces;
buffer Importance { uint data[]; } importance;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint number = faceNumber(hitFaces.data[i]);
    if (number != NO_FACE) atomicAdd(importance.data[number], uint(IMPORTANCE_ONE));
}
