// Statistics of the light around an element (light.comp), and the expected difference of two elements' irradiance.
#ifndef VOXRAY_FILTER_SURFACE_LIGHT_GLSL
#define VOXRAY_FILTER_SURFACE_LIGHT_GLSL

#include "passes/view/filter_irradiance/mean.glsl"

struct SurfaceLight {
    float mean;          // Mean luminance of the irradiance around the element, W/m².
    float meanVariance;  // Variance of this mean.
    float rayVariance;   // Variance of a single ray.
    float gradient;      // Bound of the relative change of irradiance along the surface, 1/m.
};

// The high bits of a float, rounded; `cut` bits fewer.
uint shortened(float x, int cut) { return (floatBitsToUint(x) + (1u << (cut - 1))) >> cut; }

// In 64 bits: the mean, whose differences count, has 16 bits of precision, the variance of a ray 7, the others 6.
uint64_t packLight(SurfaceLight l) {
    const uint gradient = shortened(l.gradient, 18);
    return packUint2x32(uvec2((shortened(l.mean, 8) << 8) | (gradient >> 5),
                              (gradient << 27) | (shortened(l.meanVariance, 18) << 14) | shortened(l.rayVariance, 17)));
}
SurfaceLight unpackLight(uint64_t word) {
    const uvec2 bits = unpackUint2x32(word);
    const uint gradient = ((bits.x & 0xffu) << 23) | ((bits.y >> 27) << 18);
    return SurfaceLight(uintBitsToFloat(bits.x & 0xffffff00u), uintBitsToFloat(((bits.y >> 14) & 0x1fffu) << 18),
                        uintBitsToFloat((bits.y & 0x3fffu) << 17), uintBitsToFloat(gradient));
}

void setMean(inout SurfaceLight l, Mean neighborhood) {
    l.mean = neighborhood.luminance;
    l.meanVariance =
        neighborhood.rays > 0.0 ? l.rayVariance * neighborhood.squares / square(neighborhood.rays) : 0.0;
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
    const vec3 segment = b.position - a.position;
    const float squared = dot(segment, segment), off = offPlane(a, b, segment, squared);
    const float sine = clamp(versine(a.normal, b.normal), 0.0, 1.0 - 1e-6), cosine = 1.0 - sine;
    const float noise = lightA.meanVariance + lightB.meanVariance, difference = square(lightA.mean - lightB.mean);
#ifdef SIGNED
    // Bounds from rays' deviations would be those of paths' noise: only what means differ by beyond doubt counts, and
    // for surfaces with other planes or normals the size of both
    const float size2 = 0.5 * (square(lightA.mean) + square(lightB.mean) - SIGNIFICANT * noise);
    const float unlike = max(off, 1.0 - square(cosine));
    return UNRELATED * max(size2, 0.0) * unlike + ATTENUATION * max(difference - SIGNIFICANT * noise, 0.0);
#else
    const float mean_ = 0.5 * (lightA.mean + lightB.mean), variance = 0.5 * (lightA.rayVariance + lightB.rayVariance);
    // The square of the sum of both bounds, by their squares
    const float alongSurface = square(mean_ * max(lightA.gradient, lightB.gradient)) * squared;
    const float overNormals = variance * sine / cosine;
    const float bound = alongSurface + overNormals + 2.0 * sqrt(alongSurface * overNormals);
    const float measured = max(difference - SIGNIFICANT * noise, 0.0);
    return square(edgeStoppingScale) * bound + UNRELATED * square(mean_) * off + ATTENUATION * measured;
#endif
}

#endif
