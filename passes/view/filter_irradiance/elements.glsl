// The filter's elements are the surfaces that pixels show: one in a pixel with one texel, otherwise at most two. Arrays of
// elements hold the first surfaces, row by row, then with several texels the second ones. They are arrays of 64-bit words
// by address, and not images: they may exceed maxStorageBufferRange, and Lavapipe reads a word of eight invocations at
// once, where it calls a function for a texel.
#ifndef VOXRAY_FILTER_ELEMENTS_GLSL
#define VOXRAY_FILTER_ELEMENTS_GLSL

#include "passes/common/filter/wavelet_noise.h"

#define LAYERS (SAMPLES > 1 ? 2 : 1)

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Floats { float data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Words1 { uint64_t data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Words2 { u64vec2 data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer Words3 { u64vec3 data[]; };

// @param layer 1: of the pixel's second surface.
uint elementOf(ivec2 pixel, ivec2 pixels, int layer) { return uint((layer * pixels.y + pixel.y) * pixels.x + pixel.x); }

u64vec2 packValues(vec4 v) {
    const uvec4 bits = floatBitsToUint(v);
    return u64vec2(packUint2x32(bits.xy), packUint2x32(bits.zw));
}
vec4 unpackValues(u64vec2 words) {
    return uintBitsToFloat(uvec4(unpackUint2x32(words.x), unpackUint2x32(words.y)));
}

uint64_t packHalves(vec4 v) { return packUint2x32(uvec2(packHalf2x16(v.xy), packHalf2x16(v.zw))); }
vec4 unpackHalves(uint64_t word) {
    const uvec2 bits = unpackUint2x32(word);
    return vec4(unpackHalf2x16(bits.x), unpackHalf2x16(bits.y));
}

// Two positive numbers with the range of floats, and 8 bits of precision.
uint packShort(float low, float high) {
    const uvec2 bits = floatBitsToUint(vec2(low, high)) + 0x8000u;
    return (bits.x >> 16) | (bits.y & 0xffff0000u);
}
vec2 unpackShort(uint bits) { return uintBitsToFloat(uvec2(bits << 16, bits & 0xffff0000u)); }

// 3 x 3 kernel: 1 2 1 along rows and columns.
float kernel(int x, int y) { return (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0); }

// Variance of a level's result over that of a mean of independent taps.
float overlap(int level) { return level == 0 ? 1.0 : WAVELET_OVERLAP; }

#endif
