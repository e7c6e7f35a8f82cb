#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A surfel at the hit of each surfel's ray, on the side that the ray came from, where shadow rays will measure direct light.
// Its index is its parent's. Where a ray hit nothing the surfel has no normal and so receives nothing.
#include "shaders/compute/linear_index.glsl"
#include "shaders/surfels/surfel_at_hit.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) writeonly buffer HitSurfels { Surfel data[]; } hitSurfels;
layout(push_constant) uniform Push {
    uint count;
    uint ray;   // Number of this ray among the `rays` of each surfel.
    uint rays;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel from = surfels.data[i];
    Surfel at;
    vec3 faceNormal;
    surfelAtHit(hits.data[i], from.position, at, faceNormal);
    at.id = from.id * push.rays + push.ray;
    at.parent = i;
    hitSurfels.data[i] = at;
}
