// The surface at a receiver of a batch.
#include "passes/vpls/gather_vpls/batch.glsl"

struct Receiver {
    vec3 position;    // m; off the surface, where rays may begin.
    vec3 normal;      // Unit length: the shading normal.
    vec3 faceNormal;  // Unit length: the triangle's, on the same side.
};

#ifdef SURFELS
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/surfel_types.h"

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
readonly buffer FaceNormals { uint data[]; } faceNormals;  // Octahedral.

// False where there is none.
bool receiver(VplBatch b, uint i, out Receiver r) {
    const uint number = batchSurfel(b, i);
    if (isOutside(b, number)) return false;
    const Surfel s = surfels.data[number];
    r = Receiver(s.position, s.normal, fromOctahedral(faceNormals.data[number]));
    return true;
}
#else
uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;

// False where there is none.
bool receiver(VplBatch b, uint i, out Receiver r) {
    const ivec2 texel = batchTexel(b, i);
    if (isOutside(b, texel)) return false;
    const vec4 p = texelFetch(position, texel, 0);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    r = Receiver(p.xyz + p.w * faceNormal, normalize(texelFetch(normal, texel, 0).xyz), faceNormal);
    return p.w > 0.0;
}
#endif
