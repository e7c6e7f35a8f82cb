// A surface that a pixel shows, packed into three words of 64 bits.
#ifndef VOXRAY_FILTER_SURFACE_GLSL
#define VOXRAY_FILTER_SURFACE_GLSL

struct Surface {
    vec3 position;         // m
    vec3 geometricNormal;  // Unit.
    vec3 normal;           // Unit; for shading.
};

// Unit vectors with 10 bits a coordinate: a tenth of a degree.
uint packUnit(vec3 n) {
    const uvec3 bits = uvec3(ivec3(round(511.0 * n))) & 1023u;
    return bits.x | (bits.y << 10) | (bits.z << 20);
}
vec3 unpackUnit(uint bits) { return vec3((ivec3(bits << 22, bits << 12, bits << 2)) >> 22) / 511.0; }

// @param area fraction of the pixel; 1: the pixel shows nothing else. 0: no surface.
u64vec3 packSurface(Surface s, float area) {
    const uvec3 position = floatBitsToUint(s.position);
    return u64vec3(packUint2x32(position.xy), packUint2x32(uvec2(position.z, packUnit(s.geometricNormal))),
                   packUint2x32(uvec2(packUnit(s.normal), floatBitsToUint(area))));
}

Surface unpackSurface(u64vec3 words) {
    const uvec2 xy = unpackUint2x32(words.x), z = unpackUint2x32(words.y);
    return Surface(uintBitsToFloat(uvec3(xy, z.x)), unpackUnit(z.y), unpackUnit(unpackUint2x32(words.z).x));
}

float areaOf(u64vec3 words) { return uintBitsToFloat(unpackUint2x32(words.z).y); }

float square(float x) { return x * x; }

// 1 minus the cosine between two unit vectors: exactly 0 between equal ones, however they are rounded.
float versine(vec3 a, vec3 b) {
    const vec3 difference = a - b;
    return 0.5 * dot(difference, difference);
}

// Squared sine of the angle between the segment from one surface point to the other and the plane of either, the larger
// one: 0 in a common plane, 1 perpendicular to it. Independent of scale. @param segment, squared: its squared length.
float offPlane(Surface a, Surface b, vec3 segment, float squared) {
    const float height = max(abs(dot(a.geometricNormal, segment)), abs(dot(b.geometricNormal, segment)));
    return squared > 0.0 ? min(height * height / squared, 1.0) : 0.0;
}

// Geometric edge-stopping weight, 0 to 1: the product of cosines, that of the normals to the power of 4 and that of the
// angle between the segment and the plane to the power of 20. It falls to a half where normals differ by 33 degrees, or
// the segment leaves the surface by 15.
float sameSurface(Surface a, Surface b) {
    const vec3 segment = b.position - a.position;
    const float cosine = max(1.0 - versine(a.normal, b.normal), 0.0);
    const float inPlane = 1.0 - offPlane(a, b, segment, dot(segment, segment)), squared = square(inPlane);
    return square(square(cosine)) * squared * square(square(squared));
}

// Whether two texels of a pixel show the same surface.
bool isSameSurface(Surface a, Surface b) { return sameSurface(a, b) > 0.5; }

#endif
