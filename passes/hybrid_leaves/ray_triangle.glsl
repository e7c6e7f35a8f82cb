// Watertight ray-triangle intersection: a ray through a shared edge hits at least one of its triangles.
#ifndef VOXRAY_RAY_TRIANGLE_GLSL
#define VOXRAY_RAY_TRIANGLE_GLSL

#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

// Intersects a triangle between tMin and the closest hit so far; of two at the same distance the one of lower index
// counts. Edges are tested by Plücker coordinates: the product of the ray's and an edge's changes only its sign with
// the edge's direction, so that rounding leaves no gap between neighbors (Platis and Theoharis 2003). `isMasked`:
// whether the alpha mask is looked up.
void intersectTriangle(vec3 origin, vec3 direction, float tMin, uint triangle, bool isMasked, inout Hit closest) {
    TriangleCorners corners = hybridLeaves.corners;
    precise const vec3 a = corners.data[3u * triangle] - origin, b = corners.data[3u * triangle + 1u] - origin,
                       c = corners.data[3u * triangle + 2u] - origin;
    precise const vec3 ca = c - a, ab = a - b, bc = b - c;
    precise const float u = dot(cross(ca, c + a), direction), v_ = dot(cross(ab, a + b), direction),
                        w = dot(cross(bc, b + c), direction);
    const float sum = u + v_ + w, rounding = 1.1920929e-7 * abs(sum);
    if (min(u, min(v_, w)) < -rounding && max(u, max(v_, w)) > rounding) return;

    // Intersection with the plane
    precise const vec3 normal = cross(ca, ab);
    const float slope = dot(normal, direction);
    if (slope == 0.0 || sum == 0.0) return;
    const float t = dot(normal, a) / slope;
    const bool isCloser = t < closest.t || (t == closest.t && triangle < closest.triangle);
    if (!(t >= tMin && isCloser)) return;

    const vec2 barycentrics = vec2(u, v_) / sum;
    if (isMasked && alphaCut(sceneMaterials.data[triangleMaterial(triangle)], surfacePoint(triangle, barycentrics)))
        return;
    closest = Hit(t, triangle, barycentrics.x, barycentrics.y);
}

#endif
