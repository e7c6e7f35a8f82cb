// Surfels where rays hit. Of the light from there the bound B takes the fraction 1 - d² / B at a distance d (Kollig and
// Keller 2004, section 4), which is added back.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/octahedral.glsl"
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
layout(local_size_x = 64) in;

readonly buffer HitRays { uint data[]; } hitRays;  // Indices of rays that hit.
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer PreviousSurfels { Surfel data[]; } previousSurfels;  // By ray.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
writeonly buffer FaceNormals { uint data[]; } faceNormals;
layout(push_constant, scalar) uniform Push {
    uint count;
    float minDistanceSquared;  // B, m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint ray = hitRays.data[i];
    const Surfel previous = previousSurfels.data[ray];
    Surfel hit;
    vec3 faceNormal;
    float offset;
    surfelAtHit(hits.data[ray], previous.position, hit, faceNormal, offset);
    hit.position += offset * faceNormal;
    const vec3 segment = hit.position - previous.position;
    const float missing = max(1.0 - dot(segment, segment) / push.minDistanceSquared, 0.0);
    hit.reflectance *= previous.reflectance * (missing / survivalProbability(previous.reflectance));
    hit.id = previous.id;
    hit.parent = previous.parent;
    surfels.data[i] = hit;
    faceNormals.data[i] = toOctahedral(faceNormal);
}
