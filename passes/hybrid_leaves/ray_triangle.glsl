// A ray against a triangle, watertight: of two triangles that share an edge a ray meets at least one.
#ifndef VOXRAY_RAY_TRIANGLE_GLSL
#define VOXRAY_RAY_TRIANGLE_GLSL

#include "passes/hybrid_leaves/hybrid_leaves.glsl"
#include "shaders/scene/scene.glsl"
#include "shaders/trace/ray_types.h"

// Takes a triangle for the closest hit where the ray meets it between tMin and the closest hit so far; of two at the same distance the
// first one counts. Edges are told by Plücker coordinates: the product of the ray's line and an edge's changes its sign, and
// nothing else, with the edge's direction, so that rounding opens no gap between neighbours (Platis and Theoharis 2003). `isMasked`:
// whether an alpha mask may cut the point away.
void meetTriangle(vec3 origin, vec3 direction, float tMin, uint triangle, bool isMasked, inout Hit best) {
    TriangleCorners corners = hybridLeaves.corners;
    precise const vec3 a = corners.data[3u * triangle] - origin, b = corners.data[3u * triangle + 1u] - origin,
                       c = corners.data[3u * triangle + 2u] - origin;
    precise const vec3 ca = c - a, ab = a - b, bc = b - c;
    precise const float u = dot(cross(ca, c + a), direction), v_ = dot(cross(ab, a + b), direction),
                        w = dot(cross(bc, b + c), direction);
    const float sum = u + v_ + w, rounding = 1.1920929e-7 * abs(sum);
    if (min(u, min(v_, w)) < -rounding && max(u, max(v_, w)) > rounding) return;

    // Where the ray meets the plane
    precise const vec3 normal = cross(ca, ab);
    const float slope = dot(normal, direction);
    if (slope == 0.0 || sum == 0.0) return;
    const float t = dot(normal, a) / slope;
    const bool isCloser = t < best.t || (t == best.t && triangle < best.triangle);
    if (!(t >= tMin && isCloser)) return;

    const vec2 barycentrics = vec2(u, v_) / sum;
    if (isMasked && alphaCut(sceneMaterials.data[triangleMaterial(triangle)], surfacePoint(triangle, barycentrics))) return;
    best = Hit(t, triangle, barycentrics.x, barycentrics.y);
}

#endif
