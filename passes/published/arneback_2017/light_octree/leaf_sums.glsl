// Sums over the RSM texels that see a leaf. Fixed point: order does not matter.
#ifndef VOXRAY_LEAF_SUMS_GLSL
#define VOXRAY_LEAF_SUMS_GLSL

#include "shaders/octree/brick_octree.glsl"

struct LeafSum {
    uint texels;
    uint radiance[3];  // Sum of contributions to the mean, relative to the brightest texel: at most 1.
};
const float kFixedPointOne = 1073741824.0;  // 2^30: each of 2^30 texels may round up.

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LeafSums { LeafSum data[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LeafRadiance { vec3 data[]; };
layout(scalar) buffer LeafSumsRef { LeafSums sums; };

#endif
