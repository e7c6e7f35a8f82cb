// Cones whose near field is known by rays: what the traced texels' cones have in common.
#ifndef VOXRAY_NEAR_CONES_GLSL
#define VOXRAY_NEAR_CONES_GLSL

#include "passes/cones/gather_cones/texel_stride.glsl"
#include "shaders/compute/linear_index.glsl"

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(push_constant, scalar) uniform Push {
    uvec2 places;     // Traced texels, by columns and rows.
    uint firstPlace;  // Of the batch, row by row.
    uint batchCones;  // All of a texel, then those of the next.
    uint conesPerTexel;
    int stride;
    float range;  // m: length of the rays.
    uint seed;
} push;

// The g-buffer's texel that cone i of the batch starts from. Outside of the g-buffer at the ends of some rows.
ivec2 texelOfCone(uint i) {
    const uint place = push.firstPlace + i / push.conesPerTexel;
    return tracedTexel(ivec2(place % push.places.x, place / push.places.x), push.stride);
}

#endif
