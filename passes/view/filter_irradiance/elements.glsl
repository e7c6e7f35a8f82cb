// The filter works on elements: the surfaces that pixels show. Where a pixel has one texel it has one, otherwise two at most, and
// images of elements are twice as high as the frame: below the first surfaces of all pixels lie the second ones.
#ifndef VOXRAY_FILTER_ELEMENTS_GLSL
#define VOXRAY_FILTER_ELEMENTS_GLSL

#include "passes/view/filter_irradiance/surface.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

#define LAYERS (SAMPLES > 1 ? 2 : 1)

uniform usampler2D surfaces;                                    // surface.glsl
layout(scalar) readonly buffer Second { uint data[]; } second;  // How many second surfaces there are, then their pixels.

// Which element this thread filters; false where none is left.
bool elementOfThread(ivec2 pixels, out ivec2 element) {
    const uint i = linearIndex(), count = uint(pixels.x * pixels.y);
    if (i >= count + second.data[0]) return false;
    const uint pixel = i < count ? i : second.data[1u + i - count];
    element = ivec2(pixel % pixels.x, pixel / pixels.x + (i < count ? 0 : pixels.y));
    return true;
}

// 1 2 1 along rows and columns.
float kernel(int x, int y) { return (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0); }

// By how much the variance of a level's values is above that of a mean of independent ones. From level 1 on what taps stand for
// overlaps: without edges variance falls by 4.2 a level, not by 7.1.
float overlap(int level) { return level == 0 ? 1.0 : 1.7; }

#endif
