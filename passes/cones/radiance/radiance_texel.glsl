// Radiance and opacity in 64 bits: three mantissas of 14 bits with a shared exponent of 8 bits, and 14 bits of opacity.
// Radiance has the range of floats and an error of at most 2^-14 of its largest channel; opacity has an error of at
// most 2^-15. Radiance below 2^-113 W/(m² sr) is 0.
#ifndef VOXRAY_RADIANCE_TEXEL_GLSL
#define VOXRAY_RADIANCE_TEXEL_GLSL

// Radiance is nonnegative, opacity 0 to 1.
uvec2 packRadiance(vec4 value) {
    const float largest = max(value.r, max(value.g, value.b));
    const uint exponent = floatBitsToUint(largest) >> 23;  // largest < 2^(exponent - 126)
    const uint opacity = uint(clamp(value.a, 0.0, 1.0) * 16383.0 + 0.5) << 18;
    if (exponent < 14u) return uvec2(0u, opacity);
    const uvec3 mantissa = min(uvec3(value.rgb * uintBitsToFloat((267u - exponent) << 23) + 0.5), uvec3(16383u));
    return uvec2(mantissa.r | mantissa.g << 14 | mantissa.b << 28, mantissa.b >> 4 | (exponent - 13u) << 10 | opacity);
}

vec4 unpackRadiance(uvec2 texel) {
    const uvec3 mantissa = uvec3(texel.x, texel.x >> 14, texel.x >> 28 | texel.y << 4) & 0x3fffu;
    // The stored exponent is that of the mantissas' unit as a float; 0 is a unit of 0.
    const float unit = uintBitsToFloat(texel.y << 13 & 0x7f800000u);
    return vec4(vec3(mantissa) * unit, float(texel.y >> 18) * (1.0 / 16383.0));
}

#endif
