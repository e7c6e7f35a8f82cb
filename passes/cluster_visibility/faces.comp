#version 460
#extension GL_GOOGLE_include_directive : require
// A bit for each face of a side (whose materials are bound) that has surfaces with open space before them. A thread takes a word: 32
// faces.
#include "shaders/compute/linear_index.glsl"
#include "shaders/voxels/voxels.glsl"
layout(local_size_x = 64) in;

writeonly buffer Flags { uint words[]; } flags;
layout(push_constant) uniform Push { uint faces; } push;

void main() {
    const uint word = linearIndex();
    if (32u * word >= push.faces) return;
    uint bits = 0u;
    for (uint i = 0u; i < 32u && 32u * word + i < push.faces; ++i) {
        const uint face = 32u * word + i;
        if (unoccluded(voxelMaterial(face / 6u), face % 6u) > 0.0) bits |= 1u << i;
    }
    flags.words[word] = bits;
}
