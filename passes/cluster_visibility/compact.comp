#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Moves what faces see together: a thread takes a face.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Targets { uint data[]; } targets;
layout(scalar) readonly buffer First { uint data[]; } first;
layout(scalar) writeonly buffer Seen { uint data[]; } seen;
layout(push_constant) uniform Push {
    uint faces;
    uint raysPerFace;
} push;

void main() {
    const uint face = linearIndex();
    if (face >= push.faces) return;
    const uint begin = first.data[face], end = first.data[face + 1u];
    for (uint i = begin; i < end; ++i) seen.data[i] = targets.data[face * push.raysPerFace + i - begin];
}
