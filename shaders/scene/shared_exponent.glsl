// RGB in a word as VK_FORMAT_E5B9G9R9_UFLOAT_PACK32: mantissas of 9 bits with a shared exponent of 5 bits. Channels
// from 0 to 65408; the relative error of the largest is at most 1/512.
#ifndef VOXRAY_SHARED_EXPONENT_GLSL
#define VOXRAY_SHARED_EXPONENT_GLSL

const float LARGEST_SHARED_EXPONENT = 65408.0;

uint toSharedExponent(vec3 v) {
    const vec3 clamped = clamp(v, 0.0, LARGEST_SHARED_EXPONENT);
    const float largest_ = max(clamped.x, max(clamped.y, clamped.z));
    int exponent = largest_ > 0.0 ? max(int(floor(log2(largest_))), -16) + 16 : 0;
    if (round(largest_ * exp2(float(24 - exponent))) >= 512.0) ++exponent;
    const uvec3 bits = uvec3(round(clamped * exp2(float(24 - exponent))));
    return bits.x | bits.y << 9 | bits.z << 18 | uint(exponent) << 27;
}

vec3 fromSharedExponent(uint word) {
    return vec3(word & 511u, word >> 9 & 511u, word >> 18 & 511u) * exp2(float(int(word >> 27)) - 24.0);
}

#endif
