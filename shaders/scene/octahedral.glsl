// Unit vectors in 32 bits by octahedral mapping (Cigolle et al. 2014).
#ifndef VOXRAY_OCTAHEDRAL_GLSL
#define VOXRAY_OCTAHEDRAL_GLSL

vec2 signs(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

// Coordinates on the octahedron, from -1 to 1.
vec2 octahedralPoint(vec3 n) {
    const vec3 on = n / max(abs(n.x) + abs(n.y) + abs(n.z), 1e-20);
    return on.z >= 0.0 ? on.xy : (1.0 - abs(on.yx)) * signs(on.xy);
}

uint toOctahedral(vec3 n) { return packSnorm2x16(octahedralPoint(n)); }

// @param on coordinates on the octahedron, from -1 to 1.
vec3 octahedralDirection(vec2 on) {
    const float z = 1.0 - abs(on.x) - abs(on.y);
    return normalize(vec3(z >= 0.0 ? on : (1.0 - abs(on.yx)) * signs(on), z));
}

vec3 fromOctahedral(uint bits) { return octahedralDirection(unpackSnorm2x16(bits)); }

#endif
