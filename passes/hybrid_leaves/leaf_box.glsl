// Where in its leaf a triangle of a list lies: the bounds of the triangle's part in the leaf, in steps of 1 / LEAF_BOX_STEPS of the
// leaf's edge, rounded outwards, in a word.
#ifndef VOXRAY_LEAF_BOX_GLSL
#define VOXRAY_LEAF_BOX_GLSL

#include "passes/hybrid_leaves/hybrid_types.h"

// The first and the last step along each axis, 5 bits each; then whether an alpha mask cuts the triangle, and LIST_ENDS.
#define LEAF_BOX_IS_MASKED 0x40000000u

uint packLeafBox(uvec3 first, uvec3 last) {
    return first.x | first.y << 5 | first.z << 10 | last.x << 15 | last.y << 20 | last.z << 25;
}

// The box around both; no alpha mask.
uint unionOfLeafBoxes(uint a, uint b) {
    const uvec3 first = min(uvec3(a, a >> 5, a >> 10) & 31u, uvec3(b, b >> 5, b >> 10) & 31u);
    const uvec3 last = max(uvec3(a >> 15, a >> 20, a >> 25) & 31u, uvec3(b >> 15, b >> 20, b >> 25) & 31u);
    return packLeafBox(first, last);
}

// The part of a ray in a leaf, in half steps from the leaf's corner.
struct LeafSegment {
    vec3 center;
    vec3 way;  // From the center to either end, as it counts along each axis.
};

// Whether a segment meets a box, LEAF_BOX_MARGIN larger on each side, by all separating axes (Ericson 2004, section 5.3.3).
bool meetsLeafBox(LeafSegment s, uint box) {
    const ivec3 first = ivec3(uvec3(box, box >> 5, box >> 10) & 31u), last = ivec3(uvec3(box >> 15, box >> 20, box >> 25) & 31u);
    const vec3 reach = vec3(last - first) + (1.0 + 2.0 * float(LEAF_BOX_STEPS) * LEAF_BOX_MARGIN);
    const vec3 away = vec3(first + last + 1) - s.center, width = abs(s.way);
    const vec3 across = s.way.yzx * away.zxy - s.way.zxy * away.yzx;
    return all(lessThanEqual(abs(away), reach + width)) &&
           all(lessThanEqual(abs(across), reach.yzx * width.zxy + reach.zxy * width.yzx));
}

#endif
