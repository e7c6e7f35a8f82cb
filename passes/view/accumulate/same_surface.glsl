// Whether two texels show the same surface.
#ifndef VOXRAY_ACCUMULATE_SAME_SURFACE_GLSL
#define VOXRAY_ACCUMULATE_SAME_SURFACE_GLSL

#define MIN_COSINE 0.9     // Of the angle between normals: 26 degrees.
#define MAX_SINE 0.4       // Of the angle between a surface and the line between two points on it: as much.
#define ROUNDING 1e-5      // Of a coordinate, relative to it.

bool areNormalsSimilar(vec3 normalA, vec3 normalB) { return dot(normalA, normalB) >= MIN_COSINE * length(normalA) * length(normalB); }

// Whether a point lies on the surface through another point, with that one's normal.
bool isOnSurface(vec3 point, vec3 other, vec3 normal) {
    const vec3 between = point - other, size = max(abs(point), abs(other));
    return abs(dot(normal, between)) <= MAX_SINE * length(between) + ROUNDING * max(size.x, max(size.y, size.z));
}

#endif
