// Whether two texels show the same surface.
#ifndef VOXRAY_ACCUMULATE_SAME_SURFACE_GLSL
#define VOXRAY_ACCUMULATE_SAME_SURFACE_GLSL

#define MIN_COSINE 0.9  // Of the angle between normals: 26 degrees.
#define MAX_SINE 0.4    // Of the angle between a surface and a segment between two points on it: 24 degrees.
#define ROUNDING 1e-5   // Relative rounding error of a coordinate.

bool areNormalsSimilar(vec3 normalA, vec3 normalB) {
    return dot(normalA, normalB) >= MIN_COSINE * length(normalA) * length(normalB);
}

// Whether a point lies on the surface through `surfacePoint` with the given normal.
bool isOnSurface(vec3 point, vec3 surfacePoint, vec3 normal) {
    const vec3 segment = point - surfacePoint, size = max(abs(point), abs(surfacePoint));
    return abs(dot(normal, segment)) <= MAX_SINE * length(segment) + ROUNDING * max(size.x, max(size.y, size.z));
}

#endif
