// Adds to each texel's irradiance what its surfel reflects to it.
#include "shaders/compute/linear_index.glsl"
#include "passes/vpls/gather_vpls/sums.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Arriving { vec4 data[]; } arriving;  // Irradiance of surfels, W/m².
layout(rgba32f) uniform image2D irradiance;  // Of texels, W/m².
layout(rgba32f) uniform image2D sums;
layout(push_constant, scalar) uniform Push {
    uint count;
    uint rays;     // Of each texel.
    float radius;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    const vec3 light = s.reflectance * arriving.data[i].rgb / float(push.rays);
    const uint columns = uint(imageSize(irradiance).x);
    const ivec2 texel = ivec2(s.parent % columns, s.parent / columns);
    imageStore(irradiance, texel, imageLoad(irradiance, texel) + vec4(light, 0.0));
    imageStore(sums, texel, imageLoad(sums, texel) + sumsOf(light, 1.0 / push.radius));
}
