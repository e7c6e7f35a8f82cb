// Statistics of the light around each element: the mean irradiance of its neighborhood, and the statistics of rays,
// interpolated between the centers of blocks. With LISTED around the second elements of listed pixels, else around all
// first ones.
#include "passes/view/filter_irradiance/surface_light.glsl"
#include "shaders/filter/ray_statistics.h"
#ifdef LISTED
#include "shaders/compute/indirect_list.glsl"
#endif
layout(local_size_x = 64) in;

#ifdef STATISTICS
layout(scalar) readonly buffer MeansRef { Words1 means; };
layout(scalar) readonly buffer Statistics { RayStatistics data[]; } statistics;
#endif
layout(scalar) readonly buffer SurfacesRef { Words3 surfaces; };
layout(scalar) readonly buffer LightRef { Words1 light; };  // surface_light.glsl
layout(push_constant, scalar) uniform Push {
    uvec2 pixels;
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
    const ivec2 pixels = ivec2(push.pixels);
#ifdef LISTED
    if (gl_GlobalInvocationID.x >= listedItems()) return;
    const uint item = indirectList.items[gl_GlobalInvocationID.x];  // surfaces.comp
    const ivec2 pixel = ivec2(item & 0xffffu, item >> 16);
    const uint element = elementOf(pixel, pixels, 1);
#else
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, pixels))) return;
    const uint element = elementOf(pixel, pixels, 0);
#endif
    const u64vec3 surface = surfaces.data[element];
    if (areaOf(surface) == 0.0) {
        light.data[element] = uint64_t(0);
        return;
    }

    // Without statistics assume a mean of 1 everywhere, the maximum gradient, and a ray's variance of its squared mean
    SurfaceLight found = SurfaceLight(1.0, 0.0, 1.0, 1.0e30);
    float variance = 1.0;  // Over the squared mean, or SIGNED.
#ifdef STATISTICS
    const vec2 rays = interpolatedStatistics(pixel);
    const Mean neighborhood = unpackMean(means.data[element]);
    variance = rays.y;
#ifdef SIGNED
    found.rayVariance = variance;
#else
    found.rayVariance = variance * square(neighborhood.luminance);
#endif
    setMean(found, neighborhood);
    found.gradient = rays.x;
#endif
#ifndef BOUNDED_GRADIENT
    const float minDistance = MIN_PIXELS * push.pixelAngle * distance(unpackSurface(surface).position, push.camera);
    found.gradient = min(found.gradient, sqrt(variance) / minDistance);
#endif
    light.data[element] = packLight(found);
}
