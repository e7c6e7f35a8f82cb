// Marks the faces that gather rays hit and that are not lit yet, and writes the face of each ray.
#include "passes/cache/hit_faces/mark_face.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/view/gather_layout.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Hits { Hit data[]; } hits;
writeonly buffer HitFaces { uint data[]; } hitFaces;
uniform sampler2D position;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint rays;
} push;

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.rays) return;
    hitFaces.data[i] = NO_FACE;
    const Hit hit = hits.data[i];
    if (hit.triangle == NO_HIT) return;
    const SurfacePoint s = surfacePoint(hit.triangle, vec2(hit.u, hit.v));
    if (dot(s.geometricNormal, s.geometricNormal) == 0.0) return;
    const uint blockIndex = push.firstBlock + i / g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const ivec2 texel = ivec2(texelOf(g, block, rayTexel(g, block, i % g.raysPerBlock)));
    const vec3 origin = texelFetch(position, texel, 0).xyz;
    const vec3 normal = dot(s.geometricNormal, origin - s.position) >= 0.0 ? s.geometricNormal : -s.geometricNormal;
    const uint face = hitFace(s.position, normal);
    hitFaces.data[i] = face;
    if (face != NO_FACE && faceNumber(face) == NO_FACE) markFace(face);
}
