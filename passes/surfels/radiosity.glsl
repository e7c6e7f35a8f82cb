// Radiosity of a surfel in 32 bits: 8 bits a channel and an exponent in common. Links read it at random, so that its size is what
// a bounce costs. Host: passes/radiosity/inject_radiosity/.
#ifndef VOXRAY_RADIOSITY_GLSL
#define VOXRAY_RADIOSITY_GLSL

// W/m², not negative. Rounds to nearest: the error is 1/510 of the largest channel's power of two, at most.
uint packRadiosity(vec3 radiosity) {
    int exponent;
    frexp(max(radiosity.r, max(radiosity.g, radiosity.b)), exponent);
    exponent = clamp(exponent, -127, 127);
    const uvec3 parts = uvec3(min(ldexp(radiosity, ivec3(-exponent)), 1.0) * 255.0 + 0.5);
    return parts.r | parts.g << 8 | parts.b << 16 | uint(exponent + 128) << 24;
}

vec3 unpackRadiosity(uint bits) {
    const vec3 parts = vec3(bits & 255u, bits >> 8 & 255u, bits >> 16 & 255u);
    // Two to the power of the exponent, by its bits; below 2^-126: 0.
    return parts * (uintBitsToFloat((max(bits >> 24, 1u) - 1u) << 23) / 255.0);
}

#endif
