// A surfel at each texel: where the path of a compensating ray begins.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/octahedral.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(scalar) writeonly buffer Surfels { Surfel data[]; } surfels;
writeonly buffer FaceNormals { uint data[]; } faceNormals;
layout(push_constant, scalar) uniform Push {
    uint first, count;  // Texel indices, row by row.
    uint rayInTexel, raysPerTexel;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint texelIndex = push.first + i, columns = uint(textureSize(position, 0).x);
    const ivec2 texel = ivec2(texelIndex % columns, texelIndex / columns);
    const vec4 p = texelFetch(position, texel, 0);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    // Black where there is no surface
    const vec3 reflectance = vec3(p.w > 0.0 ? 1.0 : 0.0);
    surfels.data[i] = Surfel(p.xyz + p.w * faceNormal, 0xffffffffu, normalize(texelFetch(normal, texel, 0).xyz),
                             texelIndex * push.raysPerTexel + push.rayInTexel, reflectance, texelIndex, 1.0);
    faceNormals.data[i] = toOctahedral(faceNormal);
}
