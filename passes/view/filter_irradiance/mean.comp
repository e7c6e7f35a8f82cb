// One level of an edge-avoiding à-trous wavelet (Dammertz et al. 2010) with geometric edge-stopping only: the mean
// irradiance of an element's neighborhood on the same surface. wavelet.comp compares these means to detect changes of
// light.
#include "passes/view/filter_irradiance/mean.glsl"

layout(scalar) readonly buffer SurfacesRef { Words3 surfaces; };
layout(scalar) readonly buffer SourceRef { Words1 source; };  // At level 0 of elements alone (surfaces.comp).
layout(scalar) readonly buffer ResultRef { Words1 result; };
layout(push_constant) uniform Push {
    uvec2 pixels;
    int level;
} push;

struct Tap {
    Surface surface;
    float area;
    Mean mean;
};

Tap loadTap(uint element) {
    const u64vec3 words = surfaces.data[element];
    return Tap(unpackSurface(words), areaOf(words), unpackMean(source.data[element]));
}

struct Sums { float luminances, rays, squares, weights; };

Sums emptySums() { return Sums(0.0, 0.0, 0.0, 0.0); }

float weightOf(Tap a, Tap b) { return sameSurface(a.surface, b.surface); }

void addTap(inout Sums sums, Tap center, Tap tap, float kernel_, float weight) {
    const float bySize = kernel_ * weight * tap.area, byRays = bySize * tap.mean.rays;
    sums.luminances += byRays * tap.mean.luminance;
    sums.rays += byRays;
    sums.squares += bySize * bySize * tap.mean.squares;
    sums.weights += bySize;
}

void store(uint element, Tap center, Sums sums) {
    const float rays = sums.rays, weights = sums.weights;
    const float meanSquares = overlap(push.level) * sums.squares / (weights * weights);
    const Mean mean = Mean(rays > 0.0 ? sums.luminances / rays : 0.0, rays / weights, meanSquares);
    result.data[element] = center.area > 0.0 ? packMean(mean) : uint64_t(0);
}

#include "passes/view/filter_irradiance/level.glsl"

void main() { filterLevel(ivec2(push.pixels), push.level); }
