// Radiosity of a surfel in 32 bits: 8 per channel, with a shared exponent. Random reads of it are the cost of a bounce.
#ifndef VOXRAY_RADIOSITY_GLSL
#define VOXRAY_RADIOSITY_GLSL

// W/m², not negative. Rounded to nearest: the error is at most 1/510 of the power of two above the largest channel.
uint packRadiosity(vec3 radiosity) {
    int exponent;
    frexp(max(radiosity.r, max(radiosity.g, radiosity.b)), exponent);
    exponent = clamp(exponent, -127, 127);
    const uvec3 mantissas = uvec3(min(ldexp(radiosity, ivec3(-exponent)), 1.0) * 255.0 + 0.5);
    return mantissas.r | mantissas.g << 8 | mantissas.b << 16 | uint(exponent + 128) << 24;
}

vec3 unpackRadiosity(uint bits) {
    const vec3 mantissas = vec3(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u);
    // The exponent's power of two, by the bits of a float; 0 below 2^-126
    return mantissas * (uintBitsToFloat((max(bits >> 24, 1u) - 1u) << 23) * (1.0 / 255.0));
}

#endif
