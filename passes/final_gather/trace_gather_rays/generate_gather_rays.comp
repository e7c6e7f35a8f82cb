// Generates a batch of gather rays from the G-buffer's surfaces, distributed by cosine about their normals.
#include "shaders/view/gather_layout.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstBlock;
    uint batchBlocks;
} push;

void main() {
    const GatherLayout g = push.layout_;
    const uint i = linearIndex();
    if (i >= push.batchBlocks * g.raysPerBlock) return;
    const uint blockIndex = push.firstBlock + i / g.raysPerBlock, j = i % g.raysPerBlock;
    const uvec2 block = uvec2(blockIndex % g.blocks.x, blockIndex / g.blocks.x);
    const ivec2 texel = ivec2(texelOf(g, block, rayTexel(g, block, j)));

    Ray ray = kNoRay;
    const vec4 p = all(lessThan(texel, ivec2(g.texels))) ? texelFetch(position, texel, 0) : vec4(0.0);
    if (p.w > 0.0) {
        const vec3 n = normalize(texelFetch(normal, texel, 0).xyz);
        const vec3 faceNormal = normalize(texelFetch(geometricNormal, texel, 0).xyz);
        const vec3 direction = cosineDirection(raySample(g, block, j), n);
        // Directions below the surface, as normal maps cause them, bring no light
        if (dot(direction, faceNormal) > 0.0) ray = Ray(p.xyz + faceNormal * p.w, 0.0, direction, 1.0e30);
    }
    rays.data[i] = ray;
}
