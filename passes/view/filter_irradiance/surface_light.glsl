// Statistics of the light around an element (light.comp), and the expected difference of two elements' irradiance.
#ifndef VOXRAY_FILTER_SURFACE_LIGHT_GLSL
#define VOXRAY_FILTER_SURFACE_LIGHT_GLSL

#include "passes/view/filter_irradiance/surface.glsl"

struct SurfaceLight {
    float mean;          // Mean luminance of the irradiance around the element, W/m².
    float meanVariance;  // Variance of this mean.
    float rayVariance;   // Variance of a single ray.
    float gradient;      // Bound of the relative change of irradiance along the surface, 1/m.
};

vec4 packLight(SurfaceLight l) { return vec4(l.mean, l.meanVariance, l.rayVariance, l.gradient); }
SurfaceLight unpackLight(vec4 texel) { return SurfaceLight(texel.x, texel.y, texel.z, texel.w); }

float square(float x) { return x * x; }

// neighborhood: a texel of mean.comp.
void setMean(inout SurfaceLight l, vec3 neighborhood) {
    l.mean = neighborhood.x;
    l.meanVariance =
        neighborhood.y > 0.0 ? l.rayVariance * neighborhood.z / (neighborhood.y * neighborhood.y) : 0.0;
}

// Mean squared difference of two independent values with a relative variance of 1, in units of their squared mean.
#define UNRELATED 2.0
// The measured difference of means: its weight, and the variances of noise that its square must exceed. With regression:
// means over surroundings as wide as their distance differ by half of a step between their centers, a fourth when
// squared, which makes the weight 4 at least; and noise that exceeded its variance in every third pair of taps would
// narrow the filter everywhere, three times the variance it exceeds in one of twelve. With SIGNED more, as noise of paths
// is large.
#if defined(SIGNED)
#define ATTENUATION 1.0
#define SIGNIFICANT 4.0
#elif !defined(REGRESSION)
#define ATTENUATION 1.0
#define SIGNIFICANT 1.0
#elif defined(BOUNDED_GRADIENT)
#define ATTENUATION 4.0
#define SIGNIFICANT 1.0
#else
#define ATTENUATION 8.0
#define SIGNIFICANT 3.0
#endif

// Expected mean squared difference of two elements' irradiance (wavelet.comp).
float squaredBias(Surface a, SurfaceLight lightA, Surface b, SurfaceLight lightB, float edgeStoppingScale) {
    const float cosine = clamp(dot(a.normal, b.normal), 1e-6, 1.0);
    const float noise = lightA.meanVariance + lightB.meanVariance, difference = square(lightA.mean - lightB.mean);
#ifdef SIGNED
    // Bounds from rays' deviations would be those of paths' noise: only what means differ by beyond doubt counts, and
    // for surfaces with other planes or normals the size of both
    const float size2 = 0.5 * (square(lightA.mean) + square(lightB.mean) - SIGNIFICANT * noise);
    const float unlike = max(offPlane(a, b), 1.0 - square(cosine));
    return UNRELATED * max(size2, 0.0) * unlike + ATTENUATION * max(difference - SIGNIFICANT * noise, 0.0);
#else
    const float mean_ = 0.5 * (lightA.mean + lightB.mean), variance = 0.5 * (lightA.rayVariance + lightB.rayVariance);
    const float alongSurface = mean_ * max(lightA.gradient, lightB.gradient) * distance(a.position, b.position);
    const float overNormals = sqrt(variance * (1.0 - cosine) / cosine);
    const float measured = max(difference - SIGNIFICANT * noise, 0.0);
    const float unrelated = UNRELATED * square(mean_) * offPlane(a, b);
    return square(edgeStoppingScale * (alongSurface + overNormals)) + unrelated + ATTENUATION * measured;
#endif
}

#endif
