#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// One level of the edge-avoiding à-trous wavelet filter (Dammertz et al. 2010) over irradiance: 3 x 3 taps, 2^level texels apart.
// In place of their edge-stopping functions, and of SVGF's (Schied et al. 2017), each tap's weight balances noise against bias:
//
//     weight = kernel * rays * noise / (noise + bias^2)
//
// noise: relative variance of this texel's value. One ray's relative variance (statistics.comp) over the number of rays that the
//   value stands for, which grows from level to level. Few rays: a wide filter. Many: a narrow one, in the limit none.
// bias: how far the tap's irradiance may be off, relative to either, at most. Along the surface: distance times the gradient
//   bound (statistics.comp). Over a change of normal: one ray's standard deviation times sqrt((1 - cos) / cos), which for small
//   angles is the bound of Ward et al. 1988, and grows without limit where the normals' half spaces part. Both add up the changes
//   of all surroundings as if none canceled another, so the edge-stopping scale is mostly below 1.
#include "passes/filter_irradiance/filter_types.h"
#include "shaders/scene/octahedral.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Guide { FilterTexel data[]; } guide;
uniform sampler2D source;  // Irradiance, W/m²; number of rays that it stands for.
layout(rgba32f) writeonly uniform image2D result;  // Likewise.
layout(push_constant) uniform Push {
    int step_;  // Texels between taps.
    float edgeStoppingScale;
} push;

void main() {
    const ivec2 size = imageSize(result), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    const FilterTexel own = guide.data[texel.y * size.x + texel.x];
    if (own.gradient < 0.0) {
        imageStore(result, texel, vec4(0.0));
        return;
    }

    const vec3 normal = fromOctahedral(own.normal);
    const float noise = own.variance / max(texelFetch(source, texel, 0).w, 1e-3) + 1e-12;
    vec3 sum = vec3(0.0);
    float weights = 0.0, squaredWeights = 0.0;  // The latter over the taps' rays.
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 at = texel + push.step_ * ivec2(x, y);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            const FilterTexel other = guide.data[at.y * size.x + at.x];
            const vec4 light = texelFetch(source, at, 0);
            if (other.gradient < 0.0 || light.w == 0.0) continue;
            const float cosine = clamp(dot(normal, fromOctahedral(other.normal)), 1e-6, 1.0);
            const float alongSurface = max(own.gradient, other.gradient) * distance(own.position, other.position);
            const float overNormals = sqrt(own.variance * (1.0 - cosine) / cosine);
            const float bias = push.edgeStoppingScale * (alongSurface + overNormals);
            const float kernel = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            const float weight = kernel * light.w * noise / (noise + bias * bias);
            sum += weight * light.rgb;
            weights += weight;
            squaredWeights += weight * weight / light.w;
        }

    // A weighted mean of values with 1/w the variance of one ray has the variance sum(weight^2 / w) / sum(weight)^2.
    imageStore(result, texel, weights > 0.0 ? vec4(sum / weights, weights * weights / squaredWeights) : vec4(0.0));
}
