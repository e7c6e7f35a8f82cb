#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Irradiance as filter_irradiance reads it, and sums over each block. What a texel's subset of virtual lights brings is one sample:
// the lights of a subset complement each other, and how much the subsets of a block differ tells how noisy one of them is.
#include "shaders/compute/linear_index.glsl"
#include "shaders/filter/ray_moments.h"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
layout(rgba32f) uniform image2D irradiance;  // W/m²; before: luminance over distance, W/m³; after: 1 where there is a surface.
layout(scalar) writeonly buffer Moments { RayMoments data[]; } moments;
layout(push_constant, scalar) uniform Push {
    uvec2 blocks;
    uint block;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.blocks.x * push.blocks.y) return;
    const ivec2 corner = ivec2(uvec2(i % push.blocks.x, i / push.blocks.x) * push.block);
    RayMoments sum = RayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint t = 0u; t < push.block * push.block; ++t) {
        const ivec2 texel = corner + ivec2(t % push.block, t / push.block);
        if (any(greaterThanEqual(texel, imageSize(irradiance))) || texelFetch(position, texel, 0).w == 0.0) continue;
        const vec4 e = imageLoad(irradiance, texel);
        imageStore(irradiance, texel, vec4(e.rgb, 1.0));
        const float l = luminance(e.rgb), inverseDistance = l > 0.0 ? e.w / l : 0.0;
        sum.rays += 1.0;
        sum.luminance += l;
        sum.squared += l * l;
        sum.inverseDistance += inverseDistance;
        sum.luminanceOverDistance += e.w;
        sum.squaredOverDistance += l * e.w;
    }
    moments.data[i] = sum;
}
