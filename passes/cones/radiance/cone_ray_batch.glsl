// A batch of traced texels' cones, with a ray along the axis of each.
#ifndef VOXRAY_CONE_RAY_BATCH_GLSL
#define VOXRAY_CONE_RAY_BATCH_GLSL

#include "passes/cones/radiance/texel_stride.glsl"
#include "shaders/compute/linear_index.glsl"

uniform sampler2D position;
uniform sampler2D normal;
uniform sampler2D geometricNormal;
layout(push_constant, scalar) uniform Push {
    uvec2 tracedExtent;  // Traced texels: columns and rows.
    uint firstTexel;     // Index of the batch's first traced texel, row by row.
    uint batchCones;     // Cones of the batch, texel by texel.
    uint conesPerTexel;
    int stride;
    float range;      // Length of the near field, m.
    float rayLength;  // m
    vec2 shift;       // Of directions in their strata.
#ifdef CHOOSES_CONES
    float probability;  // Of a cone to go on as a path.
    uint seed;
#endif
} push;

// The g-buffer's texel that cone i of the batch starts from; outside of the g-buffer at the ends of some rows.
ivec2 texelOfCone(uint i) {
    const uint traced = push.firstTexel + i / push.conesPerTexel;
    return tracedTexel(ivec2(traced % push.tracedExtent.x, traced / push.tracedExtent.x), push.stride);
}

// Position of a texel's directions in their strata.
vec2 directionDither(ivec2 texel) { return fract(texelDither(texel).xy + push.shift); }

#endif
