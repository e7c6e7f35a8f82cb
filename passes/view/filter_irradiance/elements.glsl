// The filter's elements are the surfaces that pixels show: one in a pixel with one texel, otherwise at most two. Images
// of elements are then twice as high as the frame: the lower half holds the second surfaces.
#ifndef VOXRAY_FILTER_ELEMENTS_GLSL
#define VOXRAY_FILTER_ELEMENTS_GLSL

#include "passes/common/filter/wavelet_noise.h"
#include "passes/view/filter_irradiance/surface.glsl"

#define LAYERS (SAMPLES > 1 ? 2 : 1)

uniform usampler2D surfaces;  // surface.glsl

// 3 x 3 kernel: 1 2 1 along rows and columns.
float kernel(int x, int y) { return (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0); }

// Variance of a level's result over that of a mean of independent taps.
float overlap(int level) { return level == 0 ? 1.0 : WAVELET_OVERLAP; }

#endif
