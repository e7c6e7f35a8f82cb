#version 460
#extension GL_GOOGLE_include_directive : require
// One ray from each surfel, distributed by cosine about its normal.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "shaders/trace/ray_types.h"
#extension GL_EXT_scalar_block_layout : require
#include "shaders/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant) uniform Push {
    uint count;
    uint ray;   // Number of this ray among the `rays` of each surfel.
    uint rays_;
    uint seed;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    Ray ray;
    ray.origin = s.position + s.normal * surfaceOffset(s.position);
    ray.direction = cosineDirection(sobol2(s.id * push.rays_ + push.ray, push.seed), s.normal);
    ray.tMin = 0.0;
    ray.tMax = 1.0e30;
    rays.data[i] = ray;
}
