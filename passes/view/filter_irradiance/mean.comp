// One level of an edge-avoiding à-trous wavelet (Dammertz et al. 2010) with geometric edge-stopping only: the mean
// irradiance of an element's neighborhood on the same surface. wavelet.comp compares these means to detect changes of
// light.
#include "passes/view/filter_irradiance/elements.glsl"
#include "shaders/scene/sampling.glsl"

// At level 0 irradiance and number of rays, then the result of the previous level.
uniform sampler2D source;
// Mean luminance, W/m²; rays per pixel; sum of their squared weights: the mean has the variance of rays² / squares
// rays.
layout(rgba32f) writeonly uniform image2D result;
layout(push_constant) uniform Push { int level; } push;

struct Tap {
    Surface surface;
    float area;
    vec3 light;  // As `result`, but at level 0 the number of rays is that of the element.
};

Tap loadTap(ivec2 element) {
    const uvec4 bits = texelFetch(surfaces, element, 0);
    const vec4 value = texelFetch(source, element, 0);
    return Tap(unpackSurface(bits), areaOf(bits),
               push.level == 0 ? vec3(luminance(value.rgb), value.aa) : value.rgb);
}

struct Sums { float luminances, rays, squares, weights; };

Sums emptySums() { return Sums(0.0, 0.0, 0.0, 0.0); }

float weightOf(Tap a, Tap b) { return sameSurface(a.surface, b.surface); }

void addTap(inout Sums sums, Tap center, Tap tap, float kernel_, float weight) {
    const float bySize = kernel_ * weight * tap.area;
    const float byRays = push.level > 0 ? bySize : tap.area > 0.0 ? kernel_ * weight : 0.0;
    sums.luminances += byRays * tap.light.y * tap.light.x;
    sums.rays += byRays * tap.light.y;
    sums.squares += byRays * byRays * tap.light.z;
    sums.weights += bySize;
}

void store(ivec2 element, Tap center, Sums sums) {
    const float rays = sums.rays, weights = sums.weights;
    const float meanSquares = overlap(push.level) * sums.squares / (weights * weights);
    imageStore(result, element,
               center.area > 0.0 ? vec4(rays > 0.0 ? sums.luminances / rays : 0.0, rays / weights, meanSquares, 0.0)
                                 : vec4(0.0));
}

#include "passes/view/filter_irradiance/level.glsl"

void main() { filterLevel(imageSize(result), push.level); }
