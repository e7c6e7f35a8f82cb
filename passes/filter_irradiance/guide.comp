#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Gathers what guides the filter at each texel into one place: its surface, and the statistics of the rays around it,
// interpolated between the centers of blocks.
#include "passes/filter_irradiance/filter_types.h"
#include "shaders/scene/octahedral.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
#ifdef MOMENTS
layout(scalar) readonly buffer Statistics { RayStatistics data[]; } statistics;
#endif
layout(scalar) writeonly buffer Guide { FilterTexel data[]; } guide;
layout(push_constant, scalar) uniform Push {
    uvec2 texels;
    uvec2 blocks;
    uint blockSize;    // Texels along a block's edge.
    float texelAngle;  // Width of a texel at unit distance.
    vec3 camera;       // m
} push;

// What is nearer than 8 texels changes irradiance within a few texels whatever the filter does, so the gradient is bounded as if
// nothing were nearer (Tabellion and Lamorlette 2004, section 5, bound the spacing of irradiance records by pixels likewise).
#define MIN_TEXELS 8.0

#ifdef MOMENTS
vec2 statisticsOf(ivec2 block) {
    const ivec2 inside = clamp(block, ivec2(0), ivec2(push.blocks) - 1);
    const RayStatistics s = statistics.data[inside.y * int(push.blocks.x) + inside.x];
    return vec2(s.gradient, s.variance);
}

// x: gradient, y: variance.
vec2 interpolatedStatistics(uvec2 texel) {
    const vec2 at = (vec2(texel) + 0.5) / float(push.blockSize) - 0.5, weight = fract(at);
    const ivec2 corner = ivec2(floor(at));
    return mix(mix(statisticsOf(corner), statisticsOf(corner + ivec2(1, 0)), weight.x),
               mix(statisticsOf(corner + ivec2(0, 1)), statisticsOf(corner + ivec2(1, 1)), weight.x), weight.y);
}
#endif

void main() {
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, push.texels))) return;
    const uint index = texel.y * push.texels.x + texel.x;
    const vec4 p = texelFetch(position, ivec2(texel), 0);
    if (p.w == 0.0) {
        guide.data[index] = FilterTexel(vec3(0.0), 0u, 0u, -1.0, 0.0);
        return;
    }

    // Without moments nothing is known of the light: the largest gradient. The variance of a ray is then taken as its squared mean.
#ifdef MOMENTS
    const vec2 light = interpolatedStatistics(texel);
#else
    const vec2 light = vec2(1.0e30, 1.0);
#endif
    const float maxGradient = sqrt(light.y) / (MIN_TEXELS * push.texelAngle * distance(p.xyz, push.camera));
    guide.data[index] = FilterTexel(p.xyz, toOctahedral(texelFetch(normal, ivec2(texel), 0).xyz),
                                    toOctahedral(texelFetch(geometricNormal, ivec2(texel), 0).xyz), min(light.x, maxGradient), light.y);
}
