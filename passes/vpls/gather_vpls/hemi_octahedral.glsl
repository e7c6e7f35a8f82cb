// Hemi-octahedral map (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors"): the
// upper half of an octahedron over a surface, unfolded to the unit square.
#include "shaders/scene/sampling.glsl"

// The octahedron's point at `uv` in [0, 1]², over a surface with the unit normal n.
vec3 hemiOctahedralPoint(vec2 uv, vec3 n) {
    vec3 tangent, bitangent;
    frame(n, tangent, bitangent);
    const vec2 square = 2.0 * uv - 1.0, p = 0.5 * vec2(square.x + square.y, square.x - square.y);
    return p.x * tangent + p.y * bitangent + (1.0 - abs(p.x) - abs(p.y)) * n;
}

// The unit direction to it.
vec3 hemiOctahedralDirection(vec2 uv, vec3 n) { return normalize(hemiOctahedralPoint(uv, n)); }

// The inverse; `direction` need not be normalized.
vec2 hemiOctahedralUv(vec3 direction, vec3 n) {
    vec3 tangent, bitangent;
    frame(n, tangent, bitangent);
    const vec3 local = vec3(dot(direction, tangent), dot(direction, bitangent), max(dot(direction, n), 0.0));
    const vec2 p = local.xy / max(abs(local.x) + abs(local.y) + local.z, 1e-30);
    return 0.5 * vec2(p.x + p.y, p.x - p.y) + 0.5;
}
