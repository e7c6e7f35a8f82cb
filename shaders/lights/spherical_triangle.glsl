// Uniform sampling of the solid angle that a triangle subtends at a point (Arvo 1995). Unlike samples by area these
// have bounded weights, however close the triangle is.
#ifndef VOXRAY_SPHERICAL_TRIANGLE_GLSL
#define VOXRAY_SPHERICAL_TRIANGLE_GLSL

// sr. Below it solid angles in floats are inaccurate, and samples by area are as good.
#define MIN_SOLID_ANGLE 0.01

struct SphericalTriangle {
    vec3 corner[3];    // Relative to the point, m.
    float solidAngle;  // sr
};

// Solid angle: Van Oosterom and Strackee 1983.
SphericalTriangle sphericalTriangle(vec3 v0, vec3 v1, vec3 v2) {
    const vec3 a = normalize(v0), b = normalize(v1), c = normalize(v2);
    const float volume = abs(dot(a, cross(b, c)));
    return SphericalTriangle(vec3[](v0, v1, v2), 2.0 * atan(volume, 1.0 + dot(a, b) + dot(b, c) + dot(c, a)));
}

// The component of v orthogonal to the unit vector n, normalized.
vec3 orthogonal(vec3 v, vec3 n) { return normalize(v - dot(v, n) * n); }

// Maps u in [0, 1)² to barycentric coordinates. The solid angle must be MIN_SOLID_ANGLE or more.
vec2 sphericalTrianglePoint(SphericalTriangle t, vec2 u) {
    const vec3 a = normalize(t.corner[0]), b = normalize(t.corner[1]), c = normalize(t.corner[2]);
    const float cosAlpha = clamp(dot(normalize(cross(a, b)), normalize(cross(a, c))), -1.0, 1.0);
    const float sinAlpha = sqrt(max(1.0 - cosAlpha * cosAlpha, 1e-12)), alpha = acos(cosAlpha);
    // Vertex C' on the arc from A to C: the triangle A B C' has the fraction u.x of the solid angle
    const float s = sin(u.x * t.solidAngle - alpha), k = cos(u.x * t.solidAngle - alpha);
    const float p = k - cosAlpha, q = s + sinAlpha * dot(a, b);
    const float cosArc = clamp(((q * k - p * s) * cosAlpha - q) / ((q * s + p * k) * sinAlpha), -1.0, 1.0);
    const vec3 vertex = cosArc * a + sqrt(1.0 - cosArc * cosArc) * orthogonal(c, a);
    // A direction on the arc from B to C'
    const float z = 1.0 - u.y * (1.0 - dot(vertex, b));
    const vec3 direction = z * b + sqrt(max(1.0 - z * z, 0.0)) * orthogonal(vertex, b);

    // Its intersection with the triangle (Möller and Trumbore 1997)
    const vec3 e1 = t.corner[1] - t.corner[0], e2 = t.corner[2] - t.corner[0], n = cross(direction, e2);
    const float scale = 1.0 / dot(e1, n);
    const float v = clamp(-dot(t.corner[0], n) * scale, 0.0, 1.0);
    return vec2(v, clamp(dot(direction, cross(-t.corner[0], e1)) * scale, 0.0, 1.0 - v));
}

#endif
