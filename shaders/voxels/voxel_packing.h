// Packing of surface voxels' data, shared by C++ and GLSL. Precision: docs/voxels.md.
//
// As a float, a packed word is NaN or infinite if and only if a value in it was: buffers of packed data are
// checked like buffers of floats.
#ifndef VOXRAY_VOXEL_PACKING_H
#define VOXRAY_VOXEL_PACKING_H

#include "shaders/voxels/voxel_types.h"

#ifdef __cplusplus
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#define VOXRAY_SHARED_FUNCTION inline
#else
#define VOXRAY_SHARED_FUNCTION
#endif

VOXRAY_SHARED_BEGIN

#ifdef __cplusplus
using glm::clamp;
using glm::floatBitsToUint;
using glm::max;
using glm::min;
using glm::uintBitsToFloat;
#endif

#define MATERIAL_WORDS 9u
// Flux of the two faces across an axis, and their areas.
#define FLUX_WORDS_PER_AXIS 3u
#define AREA_WORDS_PER_AXIS 1u

struct PackedVoxelMaterial {
    uint words[MATERIAL_WORDS];
};

VOXRAY_SHARED_FUNCTION bool isFinite(float x) {
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
}

// Two 16-bit numbers in a word. The upper one has the bits of a float's exponent: up to 0xfeff the word is a
// finite float.
#define NOT_FINITE 0xffffu
VOXRAY_SHARED_FUNCTION uint packPair(uint lower, uint upper) {
    if (lower == NOT_FINITE) upper = NOT_FINITE;
    return (lower & 0x7fffu) | ((lower & 0x8000u) << 16) | (upper << 15);
}
VOXRAY_SHARED_FUNCTION uint lowerOf(uint word) {
    return (word & 0x7fffu) | ((word >> 16) & 0x8000u);
}
VOXRAY_SHARED_FUNCTION uint upperOf(uint word) {
    return (word >> 15) & 0xffffu;
}

// From 0 to 1 in steps of about 2^-16; from -1 to 1 in steps of about 2^-15, with 0 exact.
VOXRAY_SHARED_FUNCTION uint packUnorm(float x) {
    return isFinite(x) ? uint(clamp(x, 0.0f, 1.0f) * 65278.0f + 0.5f) : NOT_FINITE;
}
VOXRAY_SHARED_FUNCTION float unpackUnorm(uint x) {
    return float(x) / 65278.0f;
}
VOXRAY_SHARED_FUNCTION uint packSnorm(float x) {
    return isFinite(x) ? uint(clamp(x, -1.0f, 1.0f) * 32639.0f + 32639.5f) : NOT_FINITE;
}
VOXRAY_SHARED_FUNCTION float unpackSnorm(uint x) {
    return (float(x) - 32639.0f) / 32639.0f;
}

// An area in units of a voxel's face, from 2^-20 to 1919: an unsigned float with 5 bits of exponent and 11 of
// mantissa. The factor of 2^-106 moves that range to the smallest normal floats, whose exponents have 5
// significant bits.
VOXRAY_SHARED_FUNCTION uint packArea(float area) {
    if (!isFinite(area)) return NOT_FINITE;
    if (area < 9.5367431640625e-7f) return 0u;
    return (floatBitsToUint(min(area, 1919.0f) * 1.2325951644078309e-32f) + 0x800u) >> 12;
}
VOXRAY_SHARED_FUNCTION float unpackArea(uint x) {
    return uintBitsToFloat(x << 12) * 8.112963841460668e31f;
}

// Nonnegative RGB with mantissas of 13 bits and a shared exponent of 8 bits at the position of a float's
// exponent: 32 bits in x, the remaining 15 in y. Values below 2^-114 become 0.
VOXRAY_SHARED_FUNCTION uvec2 packRgb(vec3 rgb) {
    const float largest = max(rgb.x, max(rgb.y, rgb.z));
    if (!isFinite(rgb.x) || !isFinite(rgb.y) || !isFinite(rgb.z)) return uvec2(0x7f800000u, 0u);
    if (largest < 4.8148248609680896e-35f) return uvec2(0u, 0u);
    const uint exponent = (floatBitsToUint(largest) + 0x400u) >> 23;  // After rounding.
    if (exponent == 255u) return uvec2(0x7f800000u, 0u);
    const float unitsPerValue = uintBitsToFloat((266u - exponent) << 23);  // The largest becomes 2^12 to 2^13.
    const uint r = uint(max(rgb.x, 0.0f) * unitsPerValue + 0.5f);
    const uint g = uint(max(rgb.y, 0.0f) * unitsPerValue + 0.5f);
    const uint b = uint(max(rgb.z, 0.0f) * unitsPerValue + 0.5f);
    return uvec2((exponent << 23) | ((g & 0x400u) << 21) | ((g & 0x3ffu) << 13) | r, (b << 2) | (g >> 11));
}
VOXRAY_SHARED_FUNCTION vec3 unpackRgb(uvec2 packed) {
    const uint exponent = (packed.x >> 23) & 0xffu;
    if (exponent == 0u) return vec3(0.0f, 0.0f, 0.0f);
    const uint r = packed.x & 0x1fffu;
    const uint g = ((packed.x >> 13) & 0x3ffu) | ((packed.x >> 21) & 0x400u) | ((packed.y & 3u) << 11);
    const uint b = packed.y >> 2;
    return vec3(float(r), float(g), float(b)) * uintBitsToFloat((exponent - 12u) << 23);
}

// The flux of a voxel's faces +a and -a: x of packRgb() for each, and y of both in a shared word.
VOXRAY_SHARED_FUNCTION uvec3 packFlux(vec3 positive, vec3 negative) {
    const uvec2 p = packRgb(positive), n = packRgb(negative);
    return uvec3(p.x, n.x, p.y | (n.y << 15));
}
VOXRAY_SHARED_FUNCTION vec3 unpackFlux(uint word, uint rest, bool negative) {
    return unpackRgb(uvec2(word, negative ? rest >> 15 : rest & 0x7fffu));
}

VOXRAY_SHARED_FUNCTION PackedVoxelMaterial packMaterial(VoxelMaterial m) {
    const uvec2 emission = packRgb(m.emission);
    PackedVoxelMaterial p;
    p.words[0] = packPair(packUnorm(m.albedo.x), packUnorm(m.albedo.y));
    p.words[1] = packPair(packUnorm(m.albedo.z), packSnorm(m.normal.x));
    p.words[2] = packPair(packSnorm(m.normal.y), packSnorm(m.normal.z));
    p.words[3] = packPair(packArea(m.unoccludedPositive.x), packArea(m.unoccludedNegative.x));
    p.words[4] = packPair(packArea(m.unoccludedPositive.y), packArea(m.unoccludedNegative.y));
    p.words[5] = packPair(packArea(m.unoccludedPositive.z), packArea(m.unoccludedNegative.z));
    p.words[6] = packPair(packArea(m.area), emission.y);
    p.words[7] = emission.x;
    p.words[8] = uint(m.opacity * 16.0f + 0.5f) | (uint(m.metallic * 255.0f + 0.5f) << 8) |
                 (uint(m.roughness * 255.0f + 0.5f) << 16);
    return p;
}
VOXRAY_SHARED_FUNCTION VoxelMaterial unpackMaterial(PackedVoxelMaterial p) {
    VoxelMaterial m;
    m.albedo =
        vec3(unpackUnorm(lowerOf(p.words[0])), unpackUnorm(upperOf(p.words[0])), unpackUnorm(lowerOf(p.words[1])));
    m.normal =
        vec3(unpackSnorm(upperOf(p.words[1])), unpackSnorm(lowerOf(p.words[2])), unpackSnorm(upperOf(p.words[2])));
    m.unoccludedPositive =
        vec3(unpackArea(lowerOf(p.words[3])), unpackArea(lowerOf(p.words[4])), unpackArea(lowerOf(p.words[5])));
    m.unoccludedNegative =
        vec3(unpackArea(upperOf(p.words[3])), unpackArea(upperOf(p.words[4])), unpackArea(upperOf(p.words[5])));
    m.area = unpackArea(lowerOf(p.words[6]));
    m.emission = unpackRgb(uvec2(p.words[7], upperOf(p.words[6])));
    m.opacity = float(p.words[8] & 0xffu) / 16.0f;
    m.metallic = float((p.words[8] >> 8) & 0xffu) / 255.0f;
    m.roughness = float((p.words[8] >> 16) & 0xffu) / 255.0f;
    return m;
}

VOXRAY_SHARED_END

#endif
