// Equal-area map between the sphere and a square (Clarberg 2008, "Fast equal-area mapping of the (hemi)sphere using
// SIMD"), so that all bins of a regular grid have the same solid angle.
#ifndef VOXRAY_EQUAL_AREA_OCTAHEDRON_GLSL
#define VOXRAY_EQUAL_AREA_OCTAHEDRON_GLSL

#include "shaders/scene/octahedral.glsl"
#include "shaders/scene/sampling.glsl"

// Direction of a point of the square [0, 1]².
vec3 equalAreaDirection(vec2 square) {
    const vec2 p = 2.0 * square - 1.0, a = abs(p);
    const float inside = 1.0 - (a.x + a.y);  // Positive in the upper hemisphere.
    const float r = 1.0 - abs(inside);       // Radius on the disc of a hemisphere.
    const float phi = r == 0.0 ? 0.0 : ((a.y - a.x) / r + 1.0) * (0.25 * PI);
    const float z = (1.0 - r * r) * (inside >= 0.0 ? 1.0 : -1.0);
    return normalize(vec3(signs(p) * vec2(cos(phi), sin(phi)) * (r * sqrt(2.0 - r * r)), z));
}

// Point of the square, [0, 1]², for a direction.
vec2 equalAreaPoint(vec3 direction) {
    const vec3 a = abs(direction);
    const float r = sqrt(max(1.0 - a.z, 0.0));
    const float y = (a.x == 0.0 && a.y == 0.0 ? 0.0 : atan(a.y, a.x) * (2.0 / PI)) * r;
    const vec2 p = direction.z >= 0.0 ? vec2(r - y, y) : 1.0 - vec2(y, r - y);
    return 0.5 + 0.5 * p * signs(direction.xy);
}

// Bin of a direction among edge² bins.
uint binOf(vec3 direction, uint edge) {
    const uvec2 bin = min(uvec2(equalAreaPoint(direction) * float(edge)), uvec2(edge - 1u));
    return bin.y * edge + bin.x;
}

vec3 binCenter(uint bin, uint edge) {
    return equalAreaDirection((vec2(bin % edge, bin / edge) + 0.5) / float(edge));
}

#endif
