// Measures the noise of a level's input, in sums over tiles (tiles.glsl): how far elements differ from the mean of their
// two neighbors along rows and columns, 2^level pixels away on the same surface, and how far they would with
// independent rays. A linear change of light adds nothing to such a difference.
#include "passes/view/filter_irradiance/noise_ratio.glsl"
#include "passes/view/filter_irradiance/surface_light.glsl"
#include "shaders/filter/tiles.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = TILE, local_size_y = TILE) in;

layout(scalar) readonly buffer SurfacesRef { Words3 surfaces; };
layout(scalar) readonly buffer LightRef { Words1 light; };
layout(scalar) readonly buffer SourceRef { Words2 source; };  // Irradiance, W/m²; number of rays that it represents.
layout(scalar) writeonly buffer Noise { NoiseSums data[]; } noise;
layout(push_constant) uniform Push {
    uvec2 pixels;
    int level;
} push;

// Least weight of surfaces that count as one (surface.glsl).
#define SAME_SURFACE 0.8
// Variance that white noise leaves in a difference, over 3/2 of what its number of rays says, by level: (3 r(0) - 4 r(1)
// + r(2)) / (3 v), where r(i) is the autocorrelation of the result of all earlier levels on a plane, i · 2^level pixels
// apart, and v = (36 / 256)^level, times WAVELET_OVERLAP for each of these levels but the first.
const float correlated[MEASURED_LEVELS] = float[](1.0, 0.7778, 0.6124);

shared NoiseSums sums[TILE * TILE];

// Of a pixel's first surface, if the pixel shows nothing else.
struct Sample {
    Surface surface;
    float luminance;
    float variance;  // Of as many independent rays.
};

bool find(ivec2 pixel, out Sample found) {
    if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, ivec2(push.pixels)))) return false;
    const uint element = elementOf(pixel, ivec2(push.pixels), 0);
    const u64vec3 words = surfaces.data[element];
    const vec4 value = unpackValues(source.data[element]);
    if (areaOf(words) < 1.0 || value.w == 0.0) return false;
    found = Sample(unpackSurface(words), luminance(value.rgb), unpackLight(light.data[element]).rayVariance / value.w);
    return true;
}

void main() {
    const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    const uint thread = gl_LocalInvocationIndex;
    NoiseSums sum = NoiseSums(0.0, 0.0);
    Sample center, before, after;
    if (find(pixel, center))
        for (int axis = 0; axis < 2; ++axis) {
            const ivec2 offset = ivec2(1 - axis, axis) << push.level;
            if (!find(pixel - offset, before) || !find(pixel + offset, after)) continue;
            if (sameSurface(center.surface, before.surface) < SAME_SURFACE ||
                sameSurface(center.surface, after.surface) < SAME_SURFACE)
                continue;
            sum.measured += square(center.luminance - 0.5 * (before.luminance + after.luminance));
            sum.independent += center.variance + 0.25 * (before.variance + after.variance);
        }
    sum.independent *= correlated[push.level];

    sums[thread] = sum;
    for (uint half_ = uint(TILE * TILE) / 2u; half_ > 0u; half_ /= 2u) {
        barrier();
        if (thread < half_) sums[thread] = added(sums[thread], sums[thread + half_]);
    }
    if (thread == 0u) noise.data[gl_WorkGroupID.y * tilesOf(push.pixels).x + gl_WorkGroupID.x] = sums[0];
}
