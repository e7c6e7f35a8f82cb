#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Moves what patches see together: a thread takes a patch.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Targets { uint data[]; } targets;
layout(scalar) readonly buffer First { uint data[]; } first;
layout(scalar) writeonly buffer Seen { uint data[]; } seen;
layout(push_constant) uniform Push {
    uint patches;
    uint raysPerPatch;
} push;

void main() {
    const uint number = linearIndex();
    if (number >= push.patches) return;
    const uint begin = first.data[number], end = first.data[number + 1u];
    for (uint i = begin; i < end; ++i) seen.data[i] = targets.data[number * push.raysPerPatch + i - begin];
}
