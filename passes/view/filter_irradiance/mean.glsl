// The mean irradiance of an element's neighborhood (mean.comp), in a word of 64 bits.
#ifndef VOXRAY_FILTER_MEAN_GLSL
#define VOXRAY_FILTER_MEAN_GLSL

#include "passes/view/filter_irradiance/elements.glsl"
#include "passes/view/filter_irradiance/surface.glsl"

struct Mean {
    float luminance;  // W/m²
    float rays;       // Per pixel.
    float squares;    // Sum of their squared weights: the mean has the variance of rays² / squares rays.
};

uint64_t packMean(Mean m) { return packUint2x32(uvec2(floatBitsToUint(m.luminance), packShort(m.rays, m.squares))); }
Mean unpackMean(uint64_t word) {
    const uvec2 bits = unpackUint2x32(word);
    const vec2 rays = unpackShort(bits.y);
    return Mean(uintBitsToFloat(bits.x), rays.x, rays.y);
}

// Of an element alone. @param rays, area of the element; the area is a fraction of the pixel.
uint64_t packOwnMean(float luminance, float rays, float area) {
    return area > 0.0 ? packMean(Mean(luminance, rays / area, rays / square(area))) : uint64_t(0);
}

#endif
