// Makes chosen hits points of their faces where these have free slots. They wait there for their light.
#include "passes/cache/hit_faces/face_point_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer PointSlots { uint data[]; } pointSlots;  // Slots that have a hit.
layout(scalar) readonly buffer SlotHits { FaceHit data[]; } slotHits;
layout(scalar) buffer PointHits { FaceHit data[]; } pointHits;
layout(push_constant) uniform Push {
    uint count;
    uint firstPoint;  // Of slot 0.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint slot = pointSlots.data[i], point = push.firstPoint + slot;
    if (pointHits.data[point].face == NO_FACE) pointHits.data[point] = slotHits.data[slot];
}
