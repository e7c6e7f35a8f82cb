// Bounds each element's irradiance by what the rays around it explain. A rare bright ray would otherwise be a spot as wide
// as the filter. keep_light.comp finds what is lost by that; with SIGNED it is summed here, over tiles (tiles.glsl), one
// work group each.
//
//     bound = mean · (1 + σ max(2.5/√rays, 1.5))
//
// mean: of the rays of the surrounding blocks; σ: a ray's standard deviation over this mean (statistics.comp). With
// many rays an element's deviation is a difference of light rather than noise, hence the 1.5. With SIGNED σ is not over
// the mean, and bounds both sides.
#include "shaders/filter/block_interpolation.glsl"
#include "passes/view/filter_irradiance/mean.glsl"
#include "shaders/filter/tiles.glsl"
#include "shaders/filter/ray_statistics.h"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = TILE, local_size_y = TILE) in;

#define DEVIATIONS 2.5            // Of an element.
#define LEAST_RAY_DEVIATIONS 1.5  // Of a ray.

layout(scalar) readonly buffer SurfacesRef { Words3 surfaces; };
layout(scalar) readonly buffer SourceRef { Words2 source; };  // Irradiance, W/m²; number of rays.
layout(scalar) readonly buffer MeansRef { Words1 means; };    // Of elements alone.
layout(scalar) readonly buffer Statistics { RayStatistics data[]; } statistics;
layout(scalar) readonly buffer BlockMeans { float data[]; } blockMeans;
#ifdef SIGNED
layout(scalar) writeonly buffer Tiles { TileLight data[]; } tiles;
#endif
layout(push_constant, scalar) uniform Push {
    uvec2 pixels;
    uvec2 blocks;
    float blockSize;
} push;

#ifdef SIGNED
shared vec3 kept[TILE * TILE];
shared vec3 excess[TILE * TILE];
#endif

// The part of an element's light that is within the bound.
float keptFraction(ivec2 pixel, float light, float rays) {
    const BlockCorner corners[4] = blockCorners(pixel, push.blockSize, push.blocks);
    float mean_ = 0.0, variance = 0.0;
    for (int i = 0; i < 4; ++i) {
        mean_ += corners[i].weight * blockMeans.data[corners[i].block];
        variance += corners[i].weight * statistics.data[corners[i].block].variance;
    }
    const float deviation = sqrt(variance) * max(DEVIATIONS * inversesqrt(max(rays, 1.0)), LEAST_RAY_DEVIATIONS);
#ifdef SIGNED
    return max(clamp(light, mean_ - deviation, mean_ + deviation) / light, 0.0);
#else
    // Of rays that are black nothing is known, and what is taken away could not be given back
    return mean_ > 0.0 ? min(mean_ * (1.0 + deviation) / light, 1.0) : 1.0;
#endif
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
#ifdef SIGNED
    const uint thread = gl_LocalInvocationIndex;
    kept[thread] = excess[thread] = vec3(0.0);
#endif
    if (all(lessThan(uvec2(pixel), push.pixels)))
        for (int layer = 0; layer < LAYERS; ++layer) {
            const uint element = elementOf(pixel, ivec2(push.pixels), layer);
            const float area = areaOf(surfaces.data[element]);
            const vec4 value = unpackValues(source.data[element]);
            const float light = luminance(value.rgb);
#ifdef SIGNED
            kept[thread] += vec3(area);
            if (area == 0.0 || light == 0.0) continue;
#else
            if (area == 0.0 || light <= 0.0) continue;
#endif
            const float fraction = keptFraction(pixel, light, value.a);
            if (fraction < 1.0) {
                source.data[element] = packValues(vec4(fraction * value.rgb, value.a));
                means.data[element] = packOwnMean(fraction * light, value.a, area);
            }
#ifdef SIGNED
            excess[thread] += area * (1.0 - fraction) * value.rgb;
#endif
        }

#ifdef SIGNED
    // Sum over the tile
    for (uint half_ = uint(TILE * TILE) / 2u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (thread < half_) {
            kept[thread] += kept[thread + half_];
            excess[thread] += excess[thread + half_];
        }
    }
    if (thread == 0u)
        tiles.data[gl_WorkGroupID.y * tilesOf(push.pixels).x + gl_WorkGroupID.x] = TileLight(kept[0], excess[0]);
#endif
}
