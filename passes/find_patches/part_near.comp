#version 460
#extension GL_GOOGLE_include_directive : require
// Sides that something hides are no neighbours. A thread takes a pair.
#include "shaders/clusters/patch_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count && occluded.data[i] != 0u) neighbours.data[push.first + i] = NO_SIDE;
}
