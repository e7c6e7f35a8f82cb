// A surfel at each texel, for the rays that find what the bound took away.
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
    uint first, count;  // Texels, row by row.
    uint ray, rays;     // Of each texel.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint number = push.first + i, columns = uint(textureSize(position, 0).x);
    const ivec2 texel = ivec2(number % columns, number / columns);
    const vec4 p = texelFetch(position, texel, 0);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    // Where there is no surface, nothing is reflected
    surfels.data[i] = Surfel(p.xyz + p.w * faceNormal, 0xffffffffu, normalize(texelFetch(normal, texel, 0).xyz), number * push.rays + push.ray,
                             vec3(p.w > 0.0 ? 1.0 : 0.0), number, 1.0);
    faceNormals.data[i] = toOctahedral(faceNormal);
}
