// The surfel of each chosen hit, and its ray, distributed by cosine. Points are in the order of their faces' numbers.
#include "passes/cache/hit_faces/face_point.glsl"
#include "passes/surfels/path_ray.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer PointSlots { uint data[]; } pointSlots;  // Slots that have a hit, ascending; not with one slot a face.
layout(scalar) readonly buffer SlotHits { FaceHit data[]; } slotHits;
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
writeonly buffer FirstPoints { uint data[]; } firstPoints;  // By face number: index of its first point.
layout(push_constant) uniform Push {
    uint first;  // Of the batch among the round's points.
    uint count;
    uint firstPoint;  // Of the round.
    uint firstFace;
    uint slotsPerFace;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint k = push.first + i, slot = push.slotsPerFace == 1u ? k : pointSlots.data[k];
    const uint face = slot / push.slotsPerFace;
    if (push.slotsPerFace == 1u || k == 0u || pointSlots.data[k - 1u] / push.slotsPerFace != face)
        firstPoints.data[push.firstFace + face] = push.firstPoint + k;

    const FaceHit hit = slotHits.data[slot];
    vec3 faceNormal_;
    const Surfel s = facePoint(hit, push.firstPoint + k, k, faceNormal_);
    surfels.data[i] = s;
    rays.data[i] = pathRay(s, faceNormal_, push.seed);
}
