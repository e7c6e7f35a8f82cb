// What is known of the light around a surface (light.comp), and how much that of two may differ.
#ifndef VOXRAY_FILTER_SURFACE_LIGHT_GLSL
#define VOXRAY_FILTER_SURFACE_LIGHT_GLSL

#include "passes/view/filter_irradiance/surface.glsl"

struct SurfaceLight {
    float mean;      // Luminance of the irradiance around, W/m².
    float meanVariance;    // Variance of that mean.
    float rayVariance;     // Variance of a single ray.
    float gradient;  // Bound of the relative change of irradiance along the surface, 1/m.
};

SurfaceLight unpackLight(vec4 texel) { return SurfaceLight(texel.x, texel.y, texel.z, texel.w); }

// Two independent values of relative variance 1 differ by 2 in the mean square, in units of their squared mean.
#define UNRELATED 2.0

float square(float x) { return x * x; }

// How much the irradiance of two surfaces may differ, in the mean square (wavelet.comp).
float squaredBias(Surface a, SurfaceLight lightA, Surface b, SurfaceLight lightB, float edgeStoppingScale) {
    const float mean_ = 0.5 * (lightA.mean + lightB.mean), variance = 0.5 * (lightA.rayVariance + lightB.rayVariance);
    const float cosine = clamp(dot(a.normal, b.normal), 1e-6, 1.0);
    const float alongSurface = mean_ * max(lightA.gradient, lightB.gradient) * distance(a.position, b.position);
    const float overNormals = sqrt(variance * (1.0 - cosine) / cosine);
    const float measured = max(square(lightA.mean - lightB.mean) - lightA.meanVariance - lightB.meanVariance, 0.0);
    return square(edgeStoppingScale * (alongSurface + overNormals)) + UNRELATED * square(mean_) * offPlane(a, b) + measured;
}

#endif
