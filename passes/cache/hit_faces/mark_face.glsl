// Marks faces that are not lit yet.
#ifndef VOXRAY_MARK_FACE_GLSL
#define VOXRAY_MARK_FACE_GLSL

#include "passes/cache/hit_faces/hit_face.glsl"

buffer MarkedFaces { uint words[]; } markedFaces;  // A bit by face.

// Many rays hit the same faces: a read saves most atomics.
void markFace(uint face) {
    const uint bit = 1u << (face & 31u);
    if ((markedFaces.words[face >> 5] & bit) == 0u) atomicOr(markedFaces.words[face >> 5], bit);
}

#endif
