// Numbers newly marked faces, in the order of their indices, and unmarks them.
#include "passes/cache/hit_faces/mark_face.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer NewFaces { uint data[]; } newFaces;
layout(push_constant) uniform Push {
    uint count;
    uint firstFace;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint face = newFaces.data[i];
    faceNumbers.data[face] = push.firstFace + i;
    markedFaces.words[face >> 5] = 0u;  // All faces of a word are numbered at once.
}
