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
#ifdef REGRESSION
#include "passes/view/filter_irradiance/regression.glsl"
#else
#include "passes/view/filter_irradiance/weighted_mean.glsl"
#endif

layout(scalar) readonly buffer SurfacesRef { Words3 surfaces; };
layout(scalar) readonly buffer LightRef { Words1 light; };    // surface_light.glsl
layout(scalar) readonly buffer SourceRef { Words2 source; };  // Irradiance, W/m²; number of rays that it represents.
layout(scalar) readonly buffer ResultRef { Words2 result; };
#ifdef NOISE_RATIO
layout(scalar) readonly buffer NoiseRatio { float data[]; } noiseRatio;  // noise_ratio.comp
#endif
layout(push_constant, scalar) uniform Push {
    uvec2 pixels;
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

// Of the variance of means over that of as many independent rays.
float noiseRatioOfLevel() {
#ifdef NOISE_RATIO
    return noiseRatio.data[push.ratioLevel];
#else
    return 1.0;
#endif
}

struct Tap {
    Surface surface;
    float area;
    SurfaceLight light;
    vec3 irradiance;    // W/m²
    float inverseRays;  // 0 without rays.
    float noise;        // Variance of the irradiance.
    float count;        // Of the element among others.
};

Tap loadTap(uint element) {
    const u64vec3 words = surfaces.data[element];
    const vec4 value = unpackValues(source.data[element]);
    Tap tap;
    tap.surface = unpackSurface(words);
    tap.area = areaOf(words);
    const float ratio = noiseRatioOfLevel();
    tap.light = unpackLight(light.data[element]);
    tap.light.meanVariance *= ratio;
    tap.irradiance = value.rgb;
    tap.inverseRays = value.w > 0.0 ? 1.0 / value.w : 0.0;
    tap.noise = ratio * tap.light.rayVariance / max(value.w, 1e-3);
    // Elements are weighted by area: at level 0 by their rays, whose number is proportional to it; later the number of
    // rays depends on how even the light is and must not weight the value
    tap.count = push.level == 0 || value.w == 0.0 ? value.w : tap.area;
    return tap;
}

struct Sums {
    Estimate estimate;
    float squaredWeights;  // Over the taps' rays.
};

Sums emptySums() { return Sums(emptyEstimate(), 0.0); }

float weightOf(Tap a, Tap b) {
    const float bias2 = squaredBias(a.surface, a.light, b.surface, b.light, push.edgeStoppingScale);
    const float noise = 0.5 * (a.noise + b.noise);
    return bias2 > 0.0 ? noise / (noise + bias2) : 1.0;
}

void addTap(inout Sums sums, Tap center, Tap tap, float kernel_, float weight) {
    const float total = tap.area > 0.0 ? kernel_ * weight * tap.count : 0.0;
    addTap(sums.estimate, total, tap.irradiance, tap.surface.position - center.surface.position);
    sums.squaredWeights += total * total * tap.inverseRays;
}

void store(uint element, Tap center, Sums sums) {
    if (center.area == 0.0 || sums.estimate.weights == 0.0) {
        result.data[element] = u64vec2(0);
        return;
    }

    vec3 value = meanOf(sums.estimate);
#ifdef REMOVES_SLOPE
    // From level 1 on remove the linear part of the bias, as far as noise allows; not at the edge of a shadow of a lamp
    // or of the sun, whose gradient is known: it is a step and no trend
    const float expected = EXPECTED_GRADIENT * center.light.mean * center.light.gradient;
    if (push.level > 0 && expected > 0.0)
        value = valueAtCenter(sums.estimate, KERNEL_SQUARES * center.noise / square(expected));
#endif

    // A weighted mean of independent values of value.w rays each has sum(weight² / value.w) / sum(weight)² of one ray's
    // variance. Where squares of weights vanish, as of taps that are nothing alike, it represents none
    const float spread = overlap(push.level) * sums.squaredWeights;
    result.data[element] = packValues(vec4(value, spread > 0.0 ? square(sums.estimate.weights) / spread : 0.0));
}

#include "passes/view/filter_irradiance/level.glsl"

void main() { filterLevel(ivec2(push.pixels), push.level); }
