// Points of a triangle that are spread evenly over the solid angle that it takes from a place (Arvo 1995). A sample by area outshines all
// others where it is near and lies by chance next to the place; one by solid angle never does.
#ifndef VOXRAY_SPHERICAL_TRIANGLE_GLSL
#define VOXRAY_SPHERICAL_TRIANGLE_GLSL

// Below it floats don't tell the solid angle well, and samples by area are as good.
#define MIN_SOLID_ANGLE 0.01

struct SphericalTriangle {
    vec3 corner[3];    // From the place, m.
    float solidAngle;  // sr
};

// Van Oosterom and Strackee 1983.
SphericalTriangle sphericalTriangle(vec3 v0, vec3 v1, vec3 v2) {
    const vec3 a = normalize(v0), b = normalize(v1), c = normalize(v2);
    const float volume = abs(dot(a, cross(b, c)));
    return SphericalTriangle(vec3[](v0, v1, v2), 2.0 * atan(volume, 1.0 + dot(a, b) + dot(b, c) + dot(c, a)));
}

// The part of v across the unit vector n, of unit length.
vec3 across(vec3 v, vec3 n) { return normalize(v - dot(v, n) * n); }

// Barycentrics of the point that belongs to u in [0, 1)²; solidAngle at least MIN_SOLID_ANGLE.
vec2 sphericalTrianglePoint(SphericalTriangle t, vec2 u) {
    const vec3 a = normalize(t.corner[0]), b = normalize(t.corner[1]), c = normalize(t.corner[2]);
    const float cosAlpha = clamp(dot(normalize(cross(a, b)), normalize(cross(a, c))), -1.0, 1.0);
    const float sinAlpha = sqrt(max(1.0 - cosAlpha * cosAlpha, 1e-12)), alpha = acos(cosAlpha);
    // The corner that cuts the part u.x of the solid angle off.
    const float s = sin(u.x * t.solidAngle - alpha), k = cos(u.x * t.solidAngle - alpha);
    const float p = k - cosAlpha, q = s + sinAlpha * dot(a, b);
    const float along = clamp(((q * k - p * s) * cosAlpha - q) / ((q * s + p * k) * sinAlpha), -1.0, 1.0);
    const vec3 cut = along * a + sqrt(1.0 - along * along) * across(c, a);
    const float z = 1.0 - u.y * (1.0 - dot(cut, b));
    const vec3 direction = z * b + sqrt(max(1.0 - z * z, 0.0)) * across(cut, b);

    // Where that direction meets the triangle (Möller and Trumbore 1997).
    const vec3 e1 = t.corner[1] - t.corner[0], e2 = t.corner[2] - t.corner[0], n = cross(direction, e2);
    const float scale = 1.0 / dot(e1, n);
    const float v = clamp(-dot(t.corner[0], n) * scale, 0.0, 1.0);
    return vec2(v, clamp(dot(direction, cross(-t.corner[0], e1)) * scale, 0.0, 1.0 - v));
}

#endif
