// Links each point to the face that its ray hits. A face that is not lit yet is marked for the next round, if Russian
// roulette by albedo and by `survival` spares the link; with KEEP_ALL each link is kept.
#include "passes/cache/hit_faces/face_point_types.h"
#include "passes/cache/hit_faces/mark_face.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer RoundHits { Hit data[]; } roundHits;
writeonly buffer HitFaces { uint data[]; } hitFaces;  // Of the round's points.
layout(scalar) writeonly buffer Links { FaceLink data[]; } links;
buffer Lost { uint value; } lost;  // Rays that hit where no voxel is.
layout(push_constant) uniform Push {
    uint first;  // Of the batch among the round's points.
    uint count;
    uint firstPoint;  // Of the round.
#ifndef KEEP_ALL
    uint seed;
    float survival;
#endif
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint k = push.first + i, point = push.firstPoint + k;
    FaceLink link = FaceLink(vec3(0.0), NO_FACE);
    Surfel s;
    vec3 normal;
    float offset;
    if (rays.data[i].tMax >= 0.0 && surfelAtHit(hits.data[i], rays.data[i].origin, s, normal, offset)) {
        link = FaceLink(s.reflectance, hitFace(s.position, normal));
        if (link.face == NO_FACE) {
            atomicAdd(lost.value, 1u);
        } else if (faceNumber(link.face) == NO_FACE) {
#ifdef KEEP_ALL
            markFace(link.face);
#else
            const float survival = push.survival * survivalProbability(s.reflectance);
            if (sobol2(point, push.seed).x < survival) {
                link.reflectance /= survival;
                markFace(link.face);
            } else {
                link.face = NO_FACE;
            }
#endif
        }
    }
    roundHits.data[k] = hits.data[i];
    hitFaces.data[k] = link.face;
    links.data[point] = link;
}
