#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// One level of an edge-avoiding wavelet filter (Dammertz et al. 2010) over irradiance, which weighs noise against bias.
//
// How much the irradiance of two texels may differ, relative to either, is at most about their distance times the bound of its
// change (blocks.comp), plus the relative deviation of a ray times sqrt((1 - n n') / n n'), which for small angles is Ward's
// bound and has none where normals share no half space. Both add up the changes of all surroundings as if none cancelled another,
// hence `strictness` below 1. How noisy a texel is, is the relative variance of a ray over the number of rays that its value
// stands for. A neighbour helps as long as the noise that it averages out outweighs the bias that it brings: its weight is
// noise / (noise + bias²). The more rays, the narrower the filter; in the limit there is none.
#include "shaders/scene/octahedral.glsl"
#include "shaders/filter/gather_filter.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Guide { FilterTexel data[]; } guide;
layout(scalar) readonly buffer Source { vec4 data[]; } source;  // Irradiance, rays that it stands for.
layout(scalar) writeonly buffer Result { vec4 data[]; } result;
layout(push_constant, scalar) uniform Push {
    uvec2 texels;
    int step_;
    float strictness;
} push;

void main() {
    const ivec2 size = ivec2(push.texels), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    const uint index = texel.y * size.x + texel.x;
    const FilterTexel own = guide.data[index];
    if (own.change < 0.0) {
        result.data[index] = vec4(0.0);
        return;
    }
    const vec3 normal = fromOctahedral(own.normal);
    const float noise = own.variance / max(source.data[index].w, 1e-3) + 1e-12;
    vec3 sum = vec3(0.0);
    float weights = 0.0, variance = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 at = texel + push.step_ * ivec2(x, y);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            const FilterTexel other = guide.data[at.y * size.x + at.x];
            const vec4 light = source.data[at.y * size.x + at.x];
            if (other.change < 0.0 || light.w == 0.0) continue;
            const float cosine = clamp(dot(normal, fromOctahedral(other.normal)), 1e-6, 1.0);
            const float moved = max(own.change, other.change) * distance(own.position, other.position);
            const float turned = sqrt(own.variance * (1.0 - cosine) / cosine);
            const float bias = push.strictness * (moved + turned);
            const float kernel = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            const float weight = kernel * light.w * noise / (noise + bias * bias);
            sum += weight * light.rgb;
            weights += weight;
            variance += weight * weight / light.w;
        }
    result.data[index] = weights > 0.0 ? vec4(sum / weights, weights * weights / variance) : vec4(0.0);
}
