// Statistics of the light around each element: the mean irradiance of its neighborhood, and the statistics of rays,
// interpolated between the centers of blocks.
#include "passes/view/filter_irradiance/block_interpolation.glsl"
#include "passes/view/filter_irradiance/elements.glsl"
#include "passes/view/filter_irradiance/surface_light.glsl"
#include "shaders/filter/ray_statistics.h"

#ifdef STATISTICS
uniform sampler2D mean;  // mean.comp
layout(scalar) readonly buffer Statistics { RayStatistics data[]; } statistics;
#endif
layout(rgba32f) writeonly uniform image2D light;  // surface_light.glsl
layout(push_constant, scalar) uniform Push {
    uvec2 blocks;
    float blockSize;   // Pixels along a block's edge.
    float pixelAngle;  // Width of a pixel at unit distance.
    vec3 camera;       // m
} push;

// Surfaces closer than 4 pixels change irradiance within a few pixels in any case, so the gradient is bounded as if
// nothing were closer (Tabellion and Lamorlette 2004, section 5, bound the spacing of irradiance records by pixels
// likewise).
#define MIN_PIXELS 4.0

#ifdef STATISTICS
RayStatistics interpolatedStatistics(ivec2 pixel) {
    const BlockCorner corners[4] = blockCorners(pixel, push.blockSize, push.blocks);
    RayStatistics found = RayStatistics(0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        const RayStatistics s = statistics.data[corners[i].block];
        found.gradient += corners[i].weight * s.gradient;
        found.variance += corners[i].weight * s.variance;
    }
    return found;
}
#endif

void main() {
    const ivec2 pixels = imageSize(light) / ivec2(1, LAYERS);
    ivec2 element;
    if (!elementOfThread(pixels, element)) return;
    const uvec4 surface = texelFetch(surfaces, element, 0);

    // Without statistics assume a mean of 1 everywhere, the maximum gradient, and a ray's variance of its squared mean
    SurfaceLight found = SurfaceLight(1.0, 0.0, 1.0, 1.0e30);
    float relativeVariance = 1.0;
#ifdef STATISTICS
    const RayStatistics rays = interpolatedStatistics(ivec2(element.x, element.y % pixels.y));
    relativeVariance = rays.variance;
    found.gradient = rays.gradient;
    const vec3 neighborhood = texelFetch(mean, element, 0).xyz;
    found.rayVariance = rays.variance * square(neighborhood.x);
    setMean(found, neighborhood);
#endif
#ifndef BOUNDED_GRADIENT
    const float minDistance = MIN_PIXELS * push.pixelAngle * distance(unpackSurface(surface).position, push.camera);
    found.gradient = min(found.gradient, sqrt(relativeVariance) / minDistance);
#endif
    imageStore(light, element, areaOf(surface) > 0.0 ? packLight(found) : vec4(0.0));
}
