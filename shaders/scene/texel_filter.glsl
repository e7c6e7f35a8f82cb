// Bilinear texture filter at level 0 with weights in full precision, as in trace/texture_lookup.cpp: samplers round
// weights, and alpha masks must be the same for all tracers.
#ifndef VOXRAY_TEXEL_FILTER_GLSL
#define VOXRAY_TEXEL_FILTER_GLSL

#include "shaders/scene/scene_types.h"

// Along one axis: two texels and the second one's weight.
struct Texels {
    int first;
    int second;
    float weight;
};

// Reduces a coordinate to the texture's period, so that no precision is lost; 0 for one that isn't finite.
float reduceCoordinate(float x, uint wrap) {
    if (!(abs(x) <= 3.4e38)) return 0.0;
    if (wrap == WRAP_REPEAT) return x - floor(x);
    if (wrap == WRAP_MIRROR) return x - 2.0 * floor(0.5 * x);
    return clamp(x, 0.0, 1.0);
}

int wrapTexel(int x, int size, uint wrap) {
    if (wrap == WRAP_REPEAT) return x < 0 ? x + size : (x >= size ? x - size : x);
    if (wrap == WRAP_CLAMP) return clamp(x, 0, size - 1);
    const int r = x < 0 ? x + 2 * size : (x >= 2 * size ? x - 2 * size : x);
    return r < size ? r : 2 * size - 1 - r;
}

Texels filteredTexels(float coordinate, int size, uint wrap, uint filter_) {
    const bool isNearest = filter_ == FILTER_NEAREST;
    const float x = reduceCoordinate(coordinate, wrap) * float(size) - (isNearest ? 0.0 : 0.5);
    const int first = int(floor(x));
    return Texels(wrapTexel(first, size, wrap), wrapTexel(first + 1, size, wrap), isNearest ? 0.0 : x - floor(x));
}

#endif
