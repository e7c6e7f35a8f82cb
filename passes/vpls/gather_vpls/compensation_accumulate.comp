// Adds the light that each surfel reflects to its texel's irradiance.
#include "shaders/compute/linear_index.glsl"
#include "passes/vpls/gather_vpls/sample_moments.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer SurfelIrradiance { vec4 data[]; } surfelIrradiance;  // W/m²
layout(rgba32f) uniform image2D irradiance;  // Of texels, W/m².
layout(rgba32f) uniform image2D texelMoments;
layout(push_constant, scalar) uniform Push {
    uint count;
    uint raysPerTexel;
    float radius;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    const vec3 reflected = s.reflectance * surfelIrradiance.data[i].rgb / float(push.raysPerTexel);
    const uint columns = uint(imageSize(irradiance).x);
    const ivec2 texel = ivec2(s.parent % columns, s.parent / columns);
    imageStore(irradiance, texel, imageLoad(irradiance, texel) + vec4(reflected, 0.0));
    imageStore(texelMoments, texel, imageLoad(texelMoments, texel) + sampleMoments(reflected, 1.0 / push.radius));
}
