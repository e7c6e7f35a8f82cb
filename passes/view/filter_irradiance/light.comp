// Statistics of the light around each element: the mean irradiance of its neighborhood, and the statistics of rays,
// interpolated between the centers of blocks.
#include "passes/view/filter_irradiance/elements.glsl"
#include "passes/view/filter_irradiance/surface_light.glsl"
#include "shaders/filter/ray_statistics.h"
layout(local_size_x = 64) in;

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
vec2 statisticsOf(ivec2 block) {
    const ivec2 inside = clamp(block, ivec2(0), ivec2(push.blocks) - 1);
    const RayStatistics s = statistics.data[inside.y * int(push.blocks.x) + inside.x];
    return vec2(s.gradient, s.variance);
}

// x: gradient, y: variance.
vec2 interpolatedStatistics(ivec2 pixel) {
    const vec2 inBlocks = (vec2(pixel) + 0.5) / push.blockSize - 0.5, weight = fract(inBlocks);
    const ivec2 corner = ivec2(floor(inBlocks));
    return mix(mix(statisticsOf(corner), statisticsOf(corner + ivec2(1, 0)), weight.x),
               mix(statisticsOf(corner + ivec2(0, 1)), statisticsOf(corner + ivec2(1, 1)), weight.x), weight.y);
}
#endif

void main() {
    const ivec2 element = ivec2(gl_GlobalInvocationID.xy), size = imageSize(light), pixels = size / ivec2(1, LAYERS);
    if (any(greaterThanEqual(element, size))) return;
    const uvec4 surface = texelFetch(surfaces, element, 0);
    if (areaOf(surface) == 0.0) {
        imageStore(light, element, vec4(0.0));
        return;
    }

    // Without statistics assume a mean of 1 everywhere, the maximum gradient, and a ray's variance of its squared mean
    SurfaceLight found = SurfaceLight(1.0, 0.0, 1.0, 1.0e30);
    float variance = 1.0;  // Over the squared mean, or SIGNED.
#ifdef STATISTICS
    const vec2 rays = interpolatedStatistics(ivec2(element.x, element.y < pixels.y ? element.y : element.y - pixels.y));
    const vec3 neighborhood = texelFetch(mean, element, 0).xyz;
    variance = rays.y;
#ifdef SIGNED
    found.rayVariance = variance;
#else
    found.rayVariance = variance * square(neighborhood.x);
#endif
    setMean(found, neighborhood);
    found.gradient = rays.x;
#endif
#ifndef BOUNDED_GRADIENT
    const float minDistance = MIN_PIXELS * push.pixelAngle * distance(unpackSurface(surface).position, push.camera);
    found.gradient = min(found.gradient, sqrt(variance) / minDistance);
#endif
    imageStore(light, element, packLight(found));
}
