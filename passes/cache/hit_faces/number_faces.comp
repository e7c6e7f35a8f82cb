// Numbers newly marked faces, in the order of their indices.
#include "passes/cache/hit_faces/hit_face.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer NewFaces { uint data[]; } newFaces;
layout(push_constant) uniform Push {
    uint count;
    uint firstFace;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) faceNumbers.data[newFaces.data[i]] = push.firstFace + i;
}
