// Gather rays, distributed by cosine about the normals of the G-buffer's surfaces.
#ifndef VOXRAY_GATHER_RAY_GLSL
#define VOXRAY_GATHER_RAY_GLSL

#include "shaders/trace/ray_types.h"
#include "shaders/view/gather_layout.glsl"

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;

// Ray j of a block; kNoRay where it has no surface to start from, or goes below it.
Ray gatherRay(GatherLayout g, uint blockIndex, uint j) {
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const ivec2 texel = ivec2(texelOf(g, block, rayTexel(g, block, j)));
    const vec4 p = all(lessThan(texel, ivec2(g.texels))) ? texelFetch(position, texel, 0) : vec4(0.0);
    if (p.w == 0.0) return kNoRay;
    const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
    const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
    const vec3 direction = cosineDirection(raySample(g, block, j), n);
    // Directions below the surface, as normal maps cause them, bring no light
    return dot(direction, faceNormal) > 0.0 ? Ray(p.xyz + faceNormal * p.w, 0.0, direction, 1.0e30) : kNoRay;
}

#endif
