// Which shadow rays of a batch their virtual lights' shadow maps block: those whose receiver's tangent plane lies behind what the
// nearest texel sees, on that texel's own ray. So flat surfaces do not shade themselves; half a texel's width is to spare for what is
// curved, and for rounding.
#include "passes/vpls/gather_vpls/hemisphere.glsl"
#include "passes/vpls/gather_vpls/receiver.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "passes/vpls/vpls.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Rays { Ray data[]; } rays;
#ifdef POINTS
readonly buffer Maps { float data[]; } maps;  // By texel: 1 / the depth, 1/m, in multiples of onHemisphere(); 0: nothing.
#else
layout(scalar) readonly buffer Hits { Hit data[]; } hits;  // By texel.
#endif
writeonly buffer Occluded { uint data[]; } occluded;
layout(push_constant, scalar) uniform Push {
    VplBatch batch;
    uint resolution;  // Texels a side.
} push;

// How far away is what a texel sees, m; false where that is nothing.
bool distanceAt(uint map, ivec2 texel, vec3 on, out float t) {
    const uint at = (map * push.resolution + uint(texel.y)) * push.resolution + uint(texel.x);
#ifdef POINTS
    t = length(on) / maps.data[at];
    return maps.data[at] > 0.0;
#else
    t = hits.data[at].t;
    return hits.data[at].triangle != NO_HIT;
#endif
}

bool isSeen(Vpl vpl, uint map, Receiver r) {
    const ivec2 last = ivec2(push.resolution) - 1;
    const vec3 way = r.position - vpl.position;
    const ivec2 texel = clamp(ivec2(hemispherePlace(way, vpl.faceNormal) * float(push.resolution)), ivec2(0), last);
    const vec3 on = onHemisphere((vec2(texel) + 0.5) / float(push.resolution), vpl.faceNormal), along = normalize(on);
    float t;
    if (!distanceAt(map, texel, on, t)) return true;
    const float towards = dot(along, r.faceNormal);
    // A texel's solid angle is 2 pi over their number, on average
    const float width = t * sqrt(2.0 * PI) / float(push.resolution);
    return towards < 0.0 && t + 0.5 * width >= dot(way, r.faceNormal) / towards;
}

void main() {
    const uint i = linearIndex();
    const VplBatch b = push.batch;
    if (i >= b.count * b.vplCount) return;
    const Ray ray = rays.data[i];
    Receiver r;
    bool isBlocked = false;
    if (ray.tMax > ray.tMin && receiver(b, i % b.count, r))
        isBlocked = !isSeen(vpls.data[list.data[b.firstVpl + i / b.count]], i / b.count, r);
    occluded.data[i] = isBlocked ? 1u : 0u;
}
