// One level of the edge-avoiding à-trous wavelet filter (Dammertz et al. 2010) over irradiance: 3 x 3 taps, 2^level
// pixels apart. Instead of their edge-stopping functions and SVGF's (Schied et al. 2017), a tap's weight balances noise
// against bias:
//
//     weight = kernel * noise / (noise + bias²)
//
// noise: mean variance of the two elements' values. The weight is symmetric; one that depended on a single element's
//   variance would move energy to where light is even. The variance is that of one ray (statistics.comp) over the
//   number of rays that the value represents, which grows from level to level: with few rays the filter is wide, with
//   many it is narrow, in the limit the identity. With regression it is multiplied by the measured noise ratio
//   (noise_ratio.comp), as rays that are stratified over pixels have less noise than independent ones.
// bias²: expected mean squared difference of the elements' irradiance, the sum of
//   - a geometric bound: along the surface the distance times the gradient bound (statistics.comp), and for different
//     normals one ray's standard deviation times sqrt((1 - cos) / cos), which for small angles is the bound of Ward et
//     al. 1988. Both bounds add absolute changes, which cancel in part, so the edge-stopping scale is mostly below 1;
//   - the difference of unrelated values, for elements on different surfaces (UNRELATED);
//   - the measured difference of the neighborhoods' means (mean.comp), beyond the noise of these means.
#include "passes/view/filter_irradiance/surface_light.glsl"
#include "passes/view/filter_irradiance/elements.glsl"
#ifdef REGRESSION
#include "passes/view/filter_irradiance/regression.glsl"
#else
#include "passes/view/filter_irradiance/weighted_mean.glsl"
#endif

uniform sampler2D light;
uniform sampler2D source;  // Irradiance, W/m²; number of rays that it represents.
layout(rgba32f) writeonly uniform image2D result;
#ifdef NOISE_RATIO
layout(scalar) readonly buffer NoiseRatio { float data[]; } noiseRatio;  // noise_ratio.comp
#endif
layout(push_constant) uniform Push {
    int level;
    float edgeStoppingScale;
#ifdef NOISE_RATIO
    uint ratioLevel;  // Of the noise ratio.
#endif
} push;

#if defined(REGRESSION) && !defined(BOUNDED_GRADIENT)
#define REMOVES_SLOPE
// Gradient to expect over its bound, along one direction: the bound adds up what mostly cancels.
#define EXPECTED_GRADIENT 0.15
// Sum of the squared weights of the whole kernel, 36 / 256.
#define KERNEL_SQUARES 0.14
#endif

// ratio: of the variance of means over that of as many independent rays.
SurfaceLight lightOf(ivec2 element, float ratio) {
    SurfaceLight found = unpackLight(texelFetch(light, element, 0));
    found.meanVariance *= ratio;
    return found;
}

void main() {
    const ivec2 pixels = imageSize(result) / ivec2(1, LAYERS);
    ivec2 element;
    if (!elementOfThread(pixels, element)) return;
    const uvec4 bits = texelFetch(surfaces, element, 0);
    if (areaOf(bits) == 0.0) {
        imageStore(result, element, vec4(0.0));
        return;
    }

    const Surface center = unpackSurface(bits);
#ifdef NOISE_RATIO
    const float ratio = noiseRatio.data[push.ratioLevel];
#else
    const float ratio = 1.0;
#endif
    const SurfaceLight centerLight = lightOf(element, ratio);
    const float centerNoise = ratio * centerLight.rayVariance / max(texelFetch(source, element, 0).w, 1e-3);
    Estimate sum = emptyEstimate();
    float squaredWeights = 0.0;  // Over the taps' rays.
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            const ivec2 pixel = ivec2(element.x, element.y % pixels.y) + (ivec2(x, y) << push.level);
            if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, pixels))) continue;
            for (int layer = 0, layers = 1; layer < layers; ++layer) {
                const ivec2 tap = pixel + ivec2(0, layer * pixels.y);
                const uvec4 neighborBits = texelFetch(surfaces, tap, 0);
                const float area = areaOf(neighborBits);
                if (area == 0.0) continue;
                if (area < 1.0) layers = LAYERS;
                const vec4 value = texelFetch(source, tap, 0);
                if (value.w == 0.0) continue;
                const Surface neighbor = unpackSurface(neighborBits);
                const SurfaceLight neighborLight = lightOf(tap, ratio);
                const float bias2 = squaredBias(center, centerLight, neighbor, neighborLight, push.edgeStoppingScale);

                // Elements are weighted by area: at level 0 by their rays, whose number is proportional to it; later
                // the number of rays depends on how even the light is and must not weight the value
                const float noise = 0.5 * (centerNoise + ratio * neighborLight.rayVariance / value.w);
                const float count = kernel(x, y) * (push.level == 0 ? value.w : area);
                const float weight = count * (bias2 > 0.0 ? noise / (noise + bias2) : 1.0);
                addTap(sum, weight, value.rgb, neighbor.position - center.position);
                squaredWeights += weight * weight / value.w;
            }
        }

    if (sum.weights == 0.0) {
        imageStore(result, element, vec4(0.0));
        return;
    }

    vec3 value = meanOf(sum);
#ifdef REMOVES_SLOPE
    // From level 1 on remove the linear part of the bias, as far as noise allows; not at the edge of a shadow of a lamp
    // or of the sun, whose gradient is known: it is a step and no trend
    const float expected = EXPECTED_GRADIENT * centerLight.mean * centerLight.gradient;
    if (push.level > 0 && expected > 0.0)
        value = valueAtCenter(sum, KERNEL_SQUARES * centerNoise / square(expected));
#endif

    // A weighted mean of independent values of value.w rays each has sum(weight² / value.w) / sum(weight)² of one ray's
    // variance. Where squares of weights vanish, as of taps that are nothing alike, it represents none
    const float rays = squaredWeights > 0.0 ? square(sum.weights) / (overlap(push.level) * squaredWeights) : 0.0;
    imageStore(result, element, vec4(value, rays));
}
