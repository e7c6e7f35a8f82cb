// The bounds of a triangle within its leaf, in steps of 1 / LEAF_BOX_STEPS of the leaf's edge, rounded outwards, in one
// word.
#ifndef VOXRAY_LEAF_BOX_GLSL
#define VOXRAY_LEAF_BOX_GLSL

#include "passes/hybrid_leaves/hybrid_types.h"

// First and last step along each axis, 5 bits each; whether the triangle has an alpha mask; LIST_ENDS.
#define LEAF_BOX_IS_MASKED 0x40000000u

uint packLeafBox(uvec3 first, uvec3 last) {
    return first.x | first.y << 5 | first.z << 10 | last.x << 15 | last.y << 20 | last.z << 25;
}

// The box around both, without the mask's bit.
uint unionOfLeafBoxes(uint a, uint b) {
    const uvec3 first = min(uvec3(a, a >> 5, a >> 10) & 31u, uvec3(b, b >> 5, b >> 10) & 31u);
    const uvec3 last = max(uvec3(a >> 15, a >> 20, a >> 25) & 31u, uvec3(b >> 15, b >> 20, b >> 25) & 31u);
    return packLeafBox(first, last);
}

// The segment of a ray in a leaf, in half steps from the leaf's corner.
struct LeafSegment {
    vec3 center;
    vec3 halfExtent;  // From the center to an end.
};

// Segment-box test by separating axes (Ericson 2004, section 5.3.3); the box is enlarged by LEAF_BOX_MARGIN.
bool intersectsLeafBox(LeafSegment s, uint box) {
    const ivec3 first = ivec3(uvec3(box, box >> 5, box >> 10) & 31u),
                last = ivec3(uvec3(box >> 15, box >> 20, box >> 25) & 31u);
    const vec3 halfSize = vec3(last - first) + (1.0 + 2.0 * float(LEAF_BOX_STEPS) * LEAF_BOX_MARGIN);
    const vec3 toBox = vec3(first + last + 1) - s.center, extent = abs(s.halfExtent);
    const vec3 crossed = s.halfExtent.yzx * toBox.zxy - s.halfExtent.zxy * toBox.yzx;
    return all(lessThanEqual(abs(toBox), halfSize + extent)) &&
           all(lessThanEqual(abs(crossed), halfSize.yzx * extent.zxy + halfSize.zxy * extent.yzx));
}

#endif
