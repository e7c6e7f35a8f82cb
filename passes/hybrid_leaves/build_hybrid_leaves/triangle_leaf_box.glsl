// The box of a triangle in a leaf (passes/hybrid_leaves/leaf_box.glsl): bounds of the triangle clipped to the leaf,
// which is enlarged by LEAF_BOX_MARGIN.
#ifndef VOXRAY_TRIANGLE_LEAF_BOX_GLSL
#define VOXRAY_TRIANGLE_LEAF_BOX_GLSL

#include "passes/hybrid_leaves/leaf_box.glsl"

// Six planes add a corner each at most.
const int MAX_CORNERS = 9;
struct Polygon {
    int count;
    vec3 corners[MAX_CORNERS];
};

// Clips a convex polygon to sign * p[axis] <= limit (Sutherland and Hodgman 1974).
Polygon clipped(Polygon polygon, int axis, float sign_, float limit) {
    Polygon result;
    result.count = 0;
    for (int i = 0; i < polygon.count; ++i) {
        const vec3 a = polygon.corners[i], b = polygon.corners[i + 1 < polygon.count ? i + 1 : 0];
        const float distanceA = sign_ * a[axis] - limit, distanceB = sign_ * b[axis] - limit;
        if (distanceA <= 0.0 && result.count < MAX_CORNERS) result.corners[result.count++] = a;
        if (distanceA * distanceB < 0.0 && result.count < MAX_CORNERS)
            result.corners[result.count++] = mix(a, b, distanceA / (distanceA - distanceB));
    }
    return result;
}

uint triangleLeafBox(TriangleFragment f) {
    const GridTriangle t = f.permutedTriangle;
    const vec3 leafCorner = vec3(f.permutedVoxel);
    Polygon polygon;
    polygon.count = 3;
    polygon.corners[0] = t.p0 - leafCorner;
    polygon.corners[1] = t.p1 - leafCorner;
    polygon.corners[2] = t.p2 - leafCorner;
    for (int axis = 0; axis < 3; ++axis) {
        polygon = clipped(polygon, axis, -1.0, LEAF_BOX_MARGIN);
        polygon = clipped(polygon, axis, 1.0, 1.0 + LEAF_BOX_MARGIN);
    }
    // The whole leaf where rounding leaves no corner
    vec3 lower = polygon.count > 0 ? polygon.corners[0] : vec3(0.0), upper = polygon.count > 0 ? lower : vec3(1.0);
    for (int i = 1; i < polygon.count; ++i) {
        lower = min(lower, polygon.corners[i]);
        upper = max(upper, polygon.corners[i]);
    }
    // Undo the permutation of axes
    lower = t.axis == 0u ? lower.zxy : t.axis == 1u ? lower.yzx : lower;
    upper = t.axis == 0u ? upper.zxy : t.axis == 1u ? upper.yzx : upper;
    const float steps = float(LEAF_BOX_STEPS);
    const uvec3 first = uvec3(clamp(floor(lower * steps), 0.0, steps - 1.0)),
                last = uvec3(clamp(floor(upper * steps), 0.0, steps - 1.0));
    return packLeafBox(first, last) | (isAlphaMasked(f) ? LEAF_BOX_IS_MASKED : 0u);
}

#endif
