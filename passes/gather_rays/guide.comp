#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What guides the filter at each texel, in one place: its surface, how noisy a single ray is there, and how fast irradiance may
// change. The last two from the rays of the blocks around it: those of a texel are too few.
//
// Irradiance E is that of a uniform surrounding, which is the same everywhere, and of what deviates from it. Of the latter, a
// surface at distance r adds at most its share of E over r to the change of E per metre (Ward, Rubinstein and Clear 1988, there
// with all light instead of the deviation). Over rays of luminance L and mean M: sum |L - M|/r / sum L, which by the inequality
// of Cauchy and Schwarz is at most sqrt(sum (L - M)²/r * sum 1/r) / sum L.
#include "shaders/octahedral.glsl"
#include "shaders/shared/gather_filter.h"
#include "shaders/shared/gather_types.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 16) uniform sampler2D position;
layout(set = 0, binding = 17) uniform sampler2D normal;
layout(set = 0, binding = 18, scalar) readonly buffer Moments { GatherMoments data[]; } moments;
layout(set = 0, binding = 19, scalar) writeonly buffer Guide { FilterTexel data[]; } guide;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    vec3 camera;       // m
    float texelAngle;  // Width of a texel at unit distance.
} push;

// Light from what is nearer than some texels changes within them anyhow: no bound is sharper than that (as Tabellion and
// Lamorlette 2004 bound the radius of irradiance records by the pixel).
#define LEAST_TEXELS 8.0

// Weights of a block and its neighbours along an axis, at `at` blocks from its middle: the quadratic B-spline.
vec3 spline(float at) { return vec3(0.5 * (0.5 - at) * (0.5 - at), 0.75 - at * at, 0.5 * (0.5 + at) * (0.5 + at)); }

void main() {
    const GatherLayout g = push.layout_;
    const uvec2 texel = gl_GlobalInvocationID.xy;
    if (any(greaterThanEqual(texel, g.texels))) return;
    const uint index = texel.y * g.texels.x + texel.x;
    const vec4 p = texelFetch(position, ivec2(texel), 0);
    if (p.w == 0.0) {
        guide.data[index] = FilterTexel(vec3(0.0), 0u, -1.0, 0.0);
        return;
    }

    const ivec2 block = ivec2(texel / g.blockSize);
    const vec2 at = (vec2(texel % g.blockSize) + 0.5) / float(g.blockSize) - 0.5;
    const vec3 across = spline(at.x), down = spline(at.y);
    GatherMoments sum = GatherMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const uvec2 other = uvec2(clamp(block + ivec2(x, y), ivec2(0), ivec2(g.blocks) - 1));
            const GatherMoments m = moments.data[other.y * g.blocks.x + other.x];
            const float weight = across[x + 1] * down[y + 1];
            sum.rays += weight * m.rays;
            sum.luminance += weight * m.luminance;
            sum.squared += weight * m.squared;
            sum.nearness += weight * m.nearness;
            sum.nearLuminance += weight * m.nearLuminance;
            sum.nearSquared += weight * m.nearSquared;
        }
    float variance = 0.0, change = 0.0;
    if (sum.luminance > 0.0) {
        const float mean = sum.luminance / sum.rays;
        const float deviation = sum.nearSquared - 2.0 * mean * sum.nearLuminance + mean * mean * sum.nearness;
        const float least = LEAST_TEXELS * push.texelAngle * distance(p.xyz, push.camera);
        variance = max(sum.squared / (sum.luminance * mean) - 1.0, 0.0);
        change = min(sqrt(max(deviation, 0.0) * sum.nearness) / sum.luminance, sqrt(variance) / least);
    }
    guide.data[index] = FilterTexel(p.xyz, toOctahedral(texelFetch(normal, ivec2(texel), 0).xyz), change, variance);
}
