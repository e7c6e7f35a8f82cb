// Sums over each block for filter_irradiance. A sample is one virtual light: n times what it brings, where a texel has n.
#include "shaders/compute/linear_index.glsl"
#include "shaders/filter/ray_moments.h"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
layout(rgba32f) uniform image2D irradiance;  // W/m²; number of virtual lights; 0 where there is no surface.
uniform sampler2D sums;  // sums.glsl
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
        // A subset without virtual lights tells as much as one light
        vec4 e = imageLoad(irradiance, texel);
        e.w = max(e.w, 1.0);
        imageStore(irradiance, texel, e);
        const vec4 of = texelFetch(sums, texel, 0);
        sum.rays += e.w;
        sum.luminance += e.w * luminance(e.rgb);
        sum.squared += e.w * e.w * of.x;
        sum.inverseDistance += of.y;
        sum.luminanceOverDistance += e.w * of.z;
        sum.squaredOverDistance += e.w * e.w * of.w;
    }
    moments.data[i] = sum;
}
