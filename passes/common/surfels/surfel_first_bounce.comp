#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The first bounce: what the surface at the hit of each surfel's ray reflects of direct light, measured there.
#include "shaders/compute/linear_index.glsl"
#include "shaders/surfels/surfel_types.h"
#include "shaders/voxels/voxel_accumulator.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer HitSurfels { Surfel data[]; } hitSurfels;
layout(scalar) readonly buffer HitDirect { vec4 data[]; } hitDirect;
layout(push_constant) uniform Push {
    uint count;
    float scale;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    writeIrradiance(s.voxel, s.normal, hitSurfels.data[i].reflectance * hitDirect.data[i].rgb, 1.0, push.scale);
}
