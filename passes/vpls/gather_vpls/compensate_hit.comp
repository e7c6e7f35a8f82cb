// The surfels where rays hit. From there comes the fraction of light that the bound B takes away at a distance d: 1 - d² / B
// (Kollig and Keller 2004, section 4).
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/octahedral.glsl"
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/surfel_at_hit.glsl"
layout(local_size_x = 64) in;

readonly buffer List { uint data[]; } list;  // Of rays that hit.
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer From { Surfel data[]; } from;  // By ray.
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
writeonly buffer FaceNormals { uint data[]; } faceNormals;
layout(push_constant, scalar) uniform Push {
    uint count;
    float minDistanceSquared;  // B, m²
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint ray = list.data[i];
    const Surfel start = from.data[ray];
    Surfel at;
    vec3 faceNormal;
    float offset;
    surfelAtHit(hits.data[ray], start.position, at, faceNormal, offset);
    at.position += offset * faceNormal;
    const vec3 way = at.position - start.position;
    at.reflectance *= start.reflectance * (max(1.0 - dot(way, way) / push.minDistanceSquared, 0.0) / survival(start.reflectance));
    at.id = start.id;
    at.parent = start.parent;
    surfels.data[i] = at;
    faceNormals.data[i] = toOctahedral(faceNormal);
}
