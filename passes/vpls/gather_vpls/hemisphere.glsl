// Maps of the hemisphere over a surface: texels of the square that an octahedron's upper half unfolds to, rotated by 45°.
#include "shaders/scene/sampling.glsl"

// The point on the octahedron of a place in [0, 1]², over a surface with the unit normal n.
vec3 onHemisphere(vec2 place, vec3 n) {
    vec3 t, b;
    frame(n, t, b);
    const vec2 square = 2.0 * place - 1.0, on = 0.5 * vec2(square.x + square.y, square.x - square.y);
    return on.x * t + on.y * b + (1.0 - abs(on.x) - abs(on.y)) * n;
}

// The same as a unit direction.
vec3 hemisphereDirection(vec2 place, vec3 n) { return normalize(onHemisphere(place, n)); }

// Its inverse; the direction need not have unit length.
vec2 hemispherePlace(vec3 direction, vec3 n) {
    vec3 t, b;
    frame(n, t, b);
    const vec3 local = vec3(dot(direction, t), dot(direction, b), max(dot(direction, n), 0.0));
    const vec2 on = local.xy / max(abs(local.x) + abs(local.y) + local.z, 1e-30);
    return 0.5 * vec2(on.x + on.y, on.x - on.y) + 0.5;
}
