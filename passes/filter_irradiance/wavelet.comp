#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
// One level of the edge-avoiding à-trous wavelet filter (Dammertz et al. 2010) over irradiance: 3 x 3 taps, 2^level texels apart.
// In place of their edge-stopping functions, and of SVGF's (Schied et al. 2017), each tap's weight balances noise against bias:
//
//     weight = kernel * noise / (noise + bias²)
//
// noise: variance of the two texels' values, the mean of both, so that neither takes more from the other than it gives: a weight
//   that depended on one alone would move energy to where light is even. One ray's variance (statistics.comp) over the number
//   of rays that the value stands for, which grows from level to level. Few rays: a wide filter. Many: a narrow one, in the limit
//   none.
// bias²: what the texels' irradiance may differ by, in the mean square. The sum of
//   - what geometry and hits bound: along the surface the distance times the gradient bound (statistics.comp), and over a change of
//     normal one ray's standard deviation times sqrt((1 - cos) / cos), which for small angles is the bound of Ward et al. 1988.
//     Both add up the changes of all surroundings as if none canceled another, so the edge-stopping scale is mostly below 1;
//   - what texels of different surfaces differ by that know nothing of each other (UNRELATED);
//   - what the means of their surroundings (mean.comp) do differ by, beyond the noise of these means.
#include "passes/filter_irradiance/wavelet.glsl"
layout(local_size_x = 8, local_size_y = 8) in;

layout(scalar) readonly buffer Guide { FilterTexel data[]; } guide;
#ifdef MOMENTS
uniform sampler2D mean;    // Mean luminance of the surroundings, W/m²; rays and sum of squared weights (mean.comp).
#endif
uniform sampler2D source;  // Irradiance, W/m²; number of rays that it stands for.
layout(rgba32f) writeonly uniform image2D result;  // Likewise.
layout(push_constant) uniform Push {
    int level;
    float edgeStoppingScale;
} push;

// Two independent values of relative variance 1 differ by 2 in the mean square, in units of their squared mean.
#define UNRELATED 2.0

// x: mean luminance of the surroundings, W/m²; y: its variance; z: variance of a single ray. Without moments light is everywhere
// the same as far as we know: 1.
vec3 surroundings(ivec2 texel, FilterTexel guide_) {
#ifdef MOMENTS
    const vec3 mean_ = texelFetch(mean, texel, 0).xyz;
    const float variance = guide_.variance * mean_.x * mean_.x;
    return vec3(mean_.x, mean_.y > 0.0 ? variance * mean_.z / (mean_.y * mean_.y) : 0.0, variance);
#else
    return vec3(1.0, 0.0, guide_.variance);
#endif
}

float square(float x) { return x * x; }

void main() {
    const ivec2 size = imageSize(result), texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, size))) return;
    const FilterTexel own = guide.data[texel.y * size.x + texel.x];
    if (own.gradient < 0.0) {
        imageStore(result, texel, vec4(0.0));
        return;
    }

    const vec3 normal = fromOctahedral(own.normal), ownLight = surroundings(texel, own);
    const float ownNoise = ownLight.z / max(texelFetch(source, texel, 0).w, 1e-3);
    vec3 sum = vec3(0.0);
    float weights = 0.0, squaredWeights = 0.0;  // The latter over the taps' rays.
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 at = texel + (ivec2(x, y) << push.level);
            if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) continue;
            const FilterTexel other = guide.data[at.y * size.x + at.x];
            const vec4 value = texelFetch(source, at, 0);
            if (other.gradient < 0.0 || value.w == 0.0) continue;

            // The bias of this tap.
            const vec3 light = surroundings(at, other);
            const float mean_ = 0.5 * (ownLight.x + light.x), variance = 0.5 * (ownLight.z + light.z);
            const float cosine = clamp(dot(normal, fromOctahedral(other.normal)), 1e-6, 1.0);
            const float alongSurface =
                mean_ * max(own.gradient, other.gradient) * distance(own.position, other.position);
            const float overNormals = sqrt(variance * (1.0 - cosine) / cosine);
            const float measured = max(square(ownLight.x - light.x) - ownLight.y - light.y, 0.0);
            const float bias2 = square(push.edgeStoppingScale * (alongSurface + overNormals)) +
                                UNRELATED * square(mean_) * offPlane(own, other) + measured;

            // Rays count once, at level 0: later the number of rays that a value stands for tells how even light is there, and
            // must not decide how much the value counts.
            const float noise = 0.5 * (ownNoise + light.z / value.w);
            const float kernel = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0) * (push.level == 0 ? value.w : 1.0);
            const float weight = kernel * (bias2 > 0.0 ? noise / (noise + bias2) : 1.0);
            sum += weight * value.rgb;
            weights += weight;
            squaredWeights += weight * weight / value.w;
        }

    // A weighted mean of values with 1/w the variance of one ray has the variance sum(weight² / w) / sum(weight)², were they
    // independent.
    const float rays = weights * weights / (overlap(push.level) * squaredWeights);
    imageStore(result, texel, weights > 0.0 ? vec4(sum / weights, rays) : vec4(0.0));
}
