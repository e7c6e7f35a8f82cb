// The box of a triangle in a leaf (passes/hybrid_leaves/leaf_box.glsl): bounds of the polygon that the leaf, LEAF_BOX_MARGIN larger on
// each side, cuts out of the triangle.
#ifndef VOXRAY_BOX_IN_LEAF_GLSL
#define VOXRAY_BOX_IN_LEAF_GLSL

#include "passes/hybrid_leaves/leaf_box.glsl"

// A triangle cut by six planes: each adds a corner at most.
const int MAX_CORNERS = 9;
struct Polygon {
    int count;
    vec3 corners[MAX_CORNERS];
};

// The part of a convex polygon where sign * p[axis] <= limit (Sutherland and Hodgman 1974).
Polygon clipped(Polygon p, int axis, float sign_, float limit) {
    Polygon result;
    result.count = 0;
    for (int i = 0; i < p.count; ++i) {
        const vec3 a = p.corners[i], b = p.corners[i + 1 < p.count ? i + 1 : 0];
        const float outA = sign_ * a[axis] - limit, outB = sign_ * b[axis] - limit;
        if (outA <= 0.0 && result.count < MAX_CORNERS) result.corners[result.count++] = a;
        if (outA * outB < 0.0 && result.count < MAX_CORNERS) result.corners[result.count++] = mix(a, b, outA / (outA - outB));
    }
    return result;
}

uint boxInLeaf(TriangleFragment f) {
    const GridTriangle t = f.permutedTriangle;
    const vec3 corner = vec3(f.permutedVoxel);
    Polygon p;
    p.count = 3;
    p.corners[0] = t.p0 - corner;
    p.corners[1] = t.p1 - corner;
    p.corners[2] = t.p2 - corner;
    for (int axis = 0; axis < 3; ++axis) {
        p = clipped(p, axis, -1.0, LEAF_BOX_MARGIN);
        p = clipped(p, axis, 1.0, 1.0 + LEAF_BOX_MARGIN);
    }
    // What rounding leaves nothing of may be anywhere
    vec3 lower = p.count > 0 ? p.corners[0] : vec3(0.0), upper = p.count > 0 ? lower : vec3(1.0);
    for (int i = 1; i < p.count; ++i) {
        lower = min(lower, p.corners[i]);
        upper = max(upper, p.corners[i]);
    }
    // Axes in the world's order
    lower = t.axis == 0u ? lower.zxy : t.axis == 1u ? lower.yzx : lower;
    upper = t.axis == 0u ? upper.zxy : t.axis == 1u ? upper.yzx : upper;
    const float steps = float(LEAF_BOX_STEPS);
    const uvec3 first = uvec3(clamp(floor(lower * steps), 0.0, steps - 1.0)), last = uvec3(clamp(floor(upper * steps), 0.0, steps - 1.0));
    return packLeafBox(first, last) | (isAlphaMasked(f) ? LEAF_BOX_IS_MASKED : 0u);
}

#endif
