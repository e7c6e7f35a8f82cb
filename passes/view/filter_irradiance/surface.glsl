// A surface that a pixel shows, in one texel of a uimage2D.
#ifndef VOXRAY_FILTER_SURFACE_GLSL
#define VOXRAY_FILTER_SURFACE_GLSL

#include "shaders/scene/octahedral.glsl"

struct Surface {
    vec3 position;         // m
    vec3 geometricNormal;  // Unit.
    vec3 normal;           // Unit; for shading.
};

// Both normals are on the octahedron: the geometric one with 9 bits a coordinate, which tells planes apart to a fifth of a degree,
// the shading normal with 6. The last two bits hold its area: the part of the pixel that shows it, in quarters, rounded up; four of
// them mean that the pixel shows nothing else.
uvec4 packSurface(Surface s, float area) {
    const vec2 geometric = unpackSnorm2x16(toOctahedral(s.geometricNormal)), shading = unpackSnorm2x16(toOctahedral(s.normal));
    const uvec2 g = uvec2(ivec2(round(geometric * 255.0)) + 256), n = uvec2(ivec2(round(shading * 31.0)) + 32);
    const uint quarters = area < 1.0 ? min(uint(ceil(4.0 * area)), 3u) : 4u;
    return uvec4(floatBitsToUint(s.position), g.x | (g.y << 9) | (n.x << 18) | (n.y << 24) | ((quarters - 1u) << 30));
}

vec3 onSphere(vec2 on) {
    const float z = 1.0 - abs(on.x) - abs(on.y);
    return normalize(vec3(z >= 0.0 ? on : (1.0 - abs(on.yx)) * signs(on), z));
}

Surface unpackSurface(uvec4 bits) {
    Surface s;
    s.position = uintBitsToFloat(bits.xyz);
    s.geometricNormal = onSphere((vec2((uvec2(bits.w) >> uvec2(0, 9)) & 511u) - 256.0) / 255.0);
    s.normal = onSphere((vec2((uvec2(bits.w) >> uvec2(18, 24)) & 63u) - 32.0) / 31.0);
    return s;
}

// The pixel's part, or 0 where there is no surface: no word of a surface is 0.
float areaOf(uvec4 bits) { return bits.w == 0u ? 0.0 : float((bits.w >> 30) + 1u) / 4.0; }

// Squared sine of the angle between the line from one surface to the other and either of them, the larger one: 0 on a plane
// that both share, 1 straight above it. It has no unit, so that it holds at any scale.
float offPlane(Surface a, Surface b) {
    const vec3 between = b.position - a.position;
    const float squared = dot(between, between);
    const float height = max(abs(dot(a.geometricNormal, between)), abs(dot(b.geometricNormal, between)));
    return squared > 0.0 ? min(height * height / squared, 1.0) : 0.0;
}

// How far light at one surface speaks for the other, by geometry alone, 0 to 1. It falls to a half where normals differ by 33
// degrees, or the line between the points leaves the surface by 15.
#define OFF_PLANE_FALLOFF 10.0
float sameSurface(Surface a, Surface b) {
    const float cosine = max(dot(a.normal, b.normal), 0.0), squared = cosine * cosine;
    return squared * squared * exp(-OFF_PLANE_FALLOFF * offPlane(a, b));
}

// Whether texels of a pixel are taken together.
bool isSameSurface(Surface a, Surface b) { return sameSurface(a, b) > 0.5; }

#endif
