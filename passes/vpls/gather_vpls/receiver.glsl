// The surface at a receiver of a batch.
#include "passes/vpls/gather_vpls/batch.glsl"

struct Receiver {
    vec3 position;    // m; off the surface, where rays may begin.
    vec3 normal;      // Unit shading normal.
    vec3 faceNormal;  // Unit normal of the triangle, on the same side.
};

#ifdef SURFELS
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/surfel_types.h"

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
readonly buffer FaceNormals { uint data[]; } faceNormals;  // Octahedral.

// False past the last surfel.
bool receiver(VplBatch b, uint i, out Receiver r) {
    const uint index = batchSurfel(b, i);
    if (isOutside(b, index)) return false;
    const Surfel s = surfels.data[index];
    r = Receiver(s.position, s.normal, fromOctahedral(faceNormals.data[index]));
    return true;
}
#else
uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;

// False where the texel shows no surface.
bool receiver(VplBatch b, uint i, out Receiver r) {
    const ivec2 texel = batchTexel(b, i);
    if (isOutside(b, texel)) return false;
    const vec4 p = texelFetch(position, texel, 0);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    r = Receiver(p.xyz + p.w * faceNormal, normalize(texelFetch(normal, texel, 0).xyz), faceNormal);
    return p.w > 0.0;
}
#endif
