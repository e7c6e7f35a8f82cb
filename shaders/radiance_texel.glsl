// Radiance and opacity in 64 bits: three mantissas of 14 bits with one exponent of 8, and 14 bits of opacity. Radiance has
// the range of floats and an error of at most 2^-14 of its largest channel (half that but at the top of an exponent);
// opacity one of 2^-15. Below 2^-113 W/(m² sr) radiance is 0.
#ifndef VOXRAY_RADIANCE_TEXEL_GLSL
#define VOXRAY_RADIANCE_TEXEL_GLSL

// Radiance is not negative, opacity from 0 to 1.
uvec2 packRadiance(vec4 value) {
    const float largest = max(value.r, max(value.g, value.b));
    const uint exponent = floatBitsToUint(largest) >> 23;  // largest < 2^(exponent - 126)
    uvec3 mantissa = uvec3(0u);
    if (exponent >= 14u)
        mantissa = min(uvec3(value.rgb * uintBitsToFloat((267u - exponent) << 23) + 0.5), uvec3(16383u));
    const uint opacity = uint(clamp(value.a, 0.0, 1.0) * 16383.0 + 0.5);
    return uvec2(mantissa.r | mantissa.g << 14 | mantissa.b << 28, mantissa.b >> 4 | exponent << 10 | opacity << 18);
}

vec4 unpackRadiance(uvec2 texel) {
    const uvec3 mantissa = uvec3(texel.x, texel.x >> 14, texel.x >> 28 | texel.y << 4) & 0x3fffu;
    const uint exponent = texel.y >> 10 & 0xffu;
    // 2^(exponent - 140), 0 where the exponent is too small for any radiance.
    const float unit = exponent >= 14u ? uintBitsToFloat((exponent - 13u) << 23) : 0.0;
    return vec4(vec3(mantissa) * unit, float(texel.y >> 18) / 16383.0);
}

#endif
