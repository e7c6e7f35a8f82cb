// Sums the moments of each block for filter_irradiance. A sample is one virtual light: with n lights at a texel, n
// times its contribution.
#include "shaders/compute/linear_index.glsl"
#include "shaders/filter/ray_moments.h"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

uniform sampler2D position;
layout(rgba32f) uniform image2D irradiance;  // W/m²; number of virtual lights.
uniform sampler2D texelMoments;  // Sums of sampleMoments().
layout(scalar) writeonly buffer Moments { RayMoments data[]; } moments;
layout(push_constant, scalar) uniform Push {
    uvec2 blocks;
    uint block;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.blocks.x * push.blocks.y) return;
    const ivec2 blockCorner = ivec2(uvec2(i % push.blocks.x, i / push.blocks.x) * push.block);
    RayMoments blockMoments = RayMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint texelInBlock = 0u; texelInBlock < push.block * push.block; ++texelInBlock) {
        const ivec2 texel = blockCorner + ivec2(texelInBlock % push.block, texelInBlock / push.block);
        if (any(greaterThanEqual(texel, imageSize(irradiance))) || texelFetch(position, texel, 0).w == 0.0) continue;
        // An empty subset counts as one black sample
        vec4 e = imageLoad(irradiance, texel);
        e.w = max(e.w, 1.0);
        imageStore(irradiance, texel, e);
        const vec4 texelMoment = texelFetch(texelMoments, texel, 0);
        blockMoments.rays += e.w;
        blockMoments.luminance += e.w * luminance(e.rgb);
        blockMoments.squared += e.w * e.w * texelMoment.x;
        blockMoments.inverseDistance += texelMoment.y;
        blockMoments.luminanceOverDistance += e.w * texelMoment.z;
        blockMoments.squaredOverDistance += e.w * e.w * texelMoment.w;
    }
    moments.data[i] = blockMoments;
}
