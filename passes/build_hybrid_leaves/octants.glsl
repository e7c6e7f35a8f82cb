// Which octants of its leaf a triangle overlaps: a bit each, by octantOf(). Octants are larger by OCTANT_MARGIN on each side.
#ifndef VOXRAY_LEAF_OCTANTS_GLSL
#define VOXRAY_LEAF_OCTANTS_GLSL

#include "shaders/hybrid_leaves/hybrid_types.h"

// Whether an axis separates a triangle from a cube of this half width about the origin (Akenine-Möller 2001, "Fast 3D Triangle-Box
// Overlap Testing").
bool separates(vec3 axis, vec3 a, vec3 b, vec3 c, float halfWidth) {
    const vec3 at = vec3(dot(axis, a), dot(axis, b), dot(axis, c));
    const float reach = halfWidth * dot(abs(axis), vec3(1.0));
    return min(at.x, min(at.y, at.z)) > reach || max(at.x, max(at.y, at.z)) < -reach;
}

bool meetsCube(vec3 a, vec3 b, vec3 c, float halfWidth) {
    const vec3 edges[] = vec3[](b - a, c - b, a - c);
    if (separates(cross(edges[0], edges[1]), a, b, c, halfWidth)) return false;
    for (uint k = 0u; k < 3u; ++k) {
        vec3 axis = vec3(0.0);
        axis[k] = 1.0;
        if (separates(axis, a, b, c, halfWidth)) return false;
        for (uint e = 0u; e < 3u; ++e)
            if (separates(cross(axis, edges[e]), a, b, c, halfWidth)) return false;
    }
    return true;
}

uint octantsOf(TriangleFragment f) {
    const GridTriangle t = f.permutedTriangle;
    const vec3 center = vec3(f.permutedVoxel) + 0.5;
    uint octants = 0u;
    for (uint octant = 0u; octant < 8u; ++octant) {
        // Of the axes as they are; the triangle's are permuted.
        const vec3 from = center + permuted(vec3(octantOffset(octant)) * 0.5 - 0.25, t.axis);
        if (meetsCube(t.p0 - from, t.p1 - from, t.p2 - from, 0.25 + OCTANT_MARGIN)) octants |= 1u << octant;
    }
    return octants;
}

#endif
