// Chooses hits as points of their faces, in two dispatches: each slot of a new face takes the hit with the smallest
// random key among those that the keys assign to it (VOTE), and that hit is stored (then). So each hit of a face is as
// likely as any other, and the choice does not depend on the order of threads.
#include "passes/cache/hit_faces/hit_face.glsl"
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

readonly buffer HitFaces { uint data[]; } hitFaces;
buffer SlotKeys { uint data[]; } slotKeys;  // At first 0xffffffff.
#ifndef VOTE
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer SlotHits { FaceHit data[]; } slotHits;
buffer TakenSlots { uint words[]; } takenSlots;  // A bit by slot.
#endif
layout(push_constant) uniform Push {
    uint count;
    uint firstHit;   // Of the batch.
    uint firstFace;  // Number of the first new face.
    uint slotsPerFace;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint face = hitFaces.data[i], number = faceNumber(face);
    if (number == NO_FACE || number < push.firstFace) return;
    const uint key = hash((push.firstHit + i) ^ push.seed);  // One hit's alone: the hash is a bijection.
    const uint slot = (number - push.firstFace) * push.slotsPerFace + hash(key) % push.slotsPerFace;
#ifdef VOTE
    atomicMin(slotKeys.data[slot], key);
#else
    if (slotKeys.data[slot] != key) return;
    const Hit hit = hits.data[i];
    slotHits.data[slot] = FaceHit(hit.triangle, hit.u, hit.v, face);
    atomicOr(takenSlots.words[slot >> 5], 1u << (slot & 31u));
#endif
}
