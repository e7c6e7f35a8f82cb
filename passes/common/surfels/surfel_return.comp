#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// What a surfel receives, direct and indirect, and reflects is the indirect light of its parent: each parent has one ray, so
// one child at most.
#include "shaders/compute/linear_index.glsl"
#include "shaders/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
layout(scalar) readonly buffer Indirect { vec4 data[]; } indirect;
layout(scalar) buffer ParentIndirect { vec4 data[]; } parentIndirect;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const vec3 irradiance = direct.data[i].rgb + indirect.data[i].rgb;
    parentIndirect.data[surfels.data[i].parent] = vec4(surfels.data[i].reflectance * irradiance, 0.0);
}
