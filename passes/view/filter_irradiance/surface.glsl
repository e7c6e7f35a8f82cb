// A surface that a pixel shows, packed into one texel of a uimage2D.
#ifndef VOXRAY_FILTER_SURFACE_GLSL
#define VOXRAY_FILTER_SURFACE_GLSL

#include "shaders/scene/octahedral.glsl"

struct Surface {
    vec3 position;         // m
    vec3 geometricNormal;  // Unit.
    vec3 normal;           // Unit; for shading.
};

// Normals are octahedral: the geometric normal with 9 bits per coordinate, a resolution of a fifth of a degree, the
// shading normal with 6. The last two bits hold the area as a fraction of the pixel, in quarters, rounded up; four
// quarters: the pixel shows nothing else.
uvec4 packSurface(Surface s, float area) {
    const vec2 geometric = unpackSnorm2x16(toOctahedral(s.geometricNormal));
    const vec2 shading = unpackSnorm2x16(toOctahedral(s.normal));
    const uvec2 g = uvec2(ivec2(round(geometric * 255.0)) + 256), n = uvec2(ivec2(round(shading * 31.0)) + 32);
    const uint quarters = area < 1.0 ? min(uint(ceil(4.0 * area)), 3u) : 4u;
    return uvec4(floatBitsToUint(s.position), g.x | (g.y << 9) | (n.x << 18) | (n.y << 24) | ((quarters - 1u) << 30));
}

Surface unpackSurface(uvec4 bits) {
    Surface s;
    s.position = uintBitsToFloat(bits.xyz);
    s.geometricNormal = octahedralDirection((vec2((uvec2(bits.w) >> uvec2(0, 9)) & 511u) - 256.0) / 255.0);
    s.normal = octahedralDirection((vec2((uvec2(bits.w) >> uvec2(18, 24)) & 63u) - 32.0) / 31.0);
    return s;
}

// Fraction of the pixel; 0 where there is no surface, as bits.w of a surface is never 0.
float areaOf(uvec4 bits) { return bits.w == 0u ? 0.0 : float((bits.w >> 30) + 1u) / 4.0; }

// Squared sine of the angle between the segment from one surface point to the other and the plane of either, the larger
// one: 0 in a common plane, 1 perpendicular to it. Independent of scale.
float offPlane(Surface a, Surface b) {
    const vec3 segment = b.position - a.position;
    const float squared = dot(segment, segment);
    const float height = max(abs(dot(a.geometricNormal, segment)), abs(dot(b.geometricNormal, segment)));
    return squared > 0.0 ? min(height * height / squared, 1.0) : 0.0;
}

// Geometric edge-stopping weight, 0 to 1. It falls to a half where normals differ by 33 degrees, or the segment between
// the points leaves the surface by 15.
#define OFF_PLANE_FALLOFF 10.0
float sameSurface(Surface a, Surface b) {
    const float cosine = max(dot(a.normal, b.normal), 0.0), squared = cosine * cosine;
    return squared * squared * exp(-OFF_PLANE_FALLOFF * offPlane(a, b));
}

// Whether two texels of a pixel show the same surface.
bool isSameSurface(Surface a, Surface b) { return sameSurface(a, b) > 0.5; }

#endif
