#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// How noisy a single ray is about each block, and how fast irradiance may change there, from the rays of the block and its
// neighbours: those of a texel are too few.
//
// Irradiance E is that of a uniform surrounding, which is the same everywhere, and of what deviates from it. Of the latter, a
// surface at distance r adds at most its share of E over r to the change of E per metre (Ward, Rubinstein and Clear 1988, there
// with all light instead of the deviation). Over rays of luminance L and mean M: sum |L - M|/r / sum L, which by the inequality
// of Cauchy and Schwarz is at most sqrt(sum (L - M)²/r * sum 1/r) / sum L.
#include "shaders/filter/gather_filter.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Moments { GatherMoments data[]; } moments;
layout(scalar) writeonly buffer Blocks { vec2 data[]; } blocks;  // Change, 1/m; variance.
layout(push_constant) uniform Push { uvec2 count; } push;

void main() {
    const ivec2 block = ivec2(gl_GlobalInvocationID.xy), last = ivec2(push.count) - 1;
    if (any(greaterThan(block, last))) return;
    GatherMoments sum = GatherMoments(0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 other = clamp(block + ivec2(x, y), ivec2(0), last);
            const GatherMoments m = moments.data[other.y * int(push.count.x) + other.x];
            const float weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            sum.rays += weight * m.rays;
            sum.luminance += weight * m.luminance;
            sum.squared += weight * m.squared;
            sum.nearness += weight * m.nearness;
            sum.nearLuminance += weight * m.nearLuminance;
            sum.nearSquared += weight * m.nearSquared;
        }
    vec2 found = vec2(0.0);
    if (sum.luminance > 0.0) {
        const float mean = sum.luminance / sum.rays;
        const float deviation = sum.nearSquared - 2.0 * mean * sum.nearLuminance + mean * mean * sum.nearness;
        found = vec2(sqrt(max(deviation, 0.0) * sum.nearness) / sum.luminance,
                     max(sum.squared / (sum.luminance * mean) - 1.0, 0.0));
    }
    blocks.data[block.y * int(push.count.x) + block.x] = found;
}
