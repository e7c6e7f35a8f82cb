#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// The virtual lights that are kept, each with the flux of those that it stands for.
#include "shaders/compute/linear_index.glsl"
#include "shaders/vpls/vpl_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer From { Vpl data[]; } from;
readonly buffer List { uint data[]; } list;
layout(scalar) readonly buffer Weights { float data[]; } weights;  // By place in the list.
layout(scalar) writeonly buffer To { Vpl data[]; } to;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    Vpl vpl = from.data[list.data[i]];
    vpl.flux *= weights.data[i];
    to.data[list.data[i]] = vpl;
}
