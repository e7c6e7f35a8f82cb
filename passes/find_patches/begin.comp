#version 460
#extension GL_GOOGLE_include_directive : require
// The surfels of all voxels, on no side yet. A thread takes one of a chunk.
#include "shaders/clusters/patches.glsl"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer SlotsAt { LargeUints slots; };
layout(push_constant) uniform Push {
    uint count;
    uint firstNumber;
    float voxelSize;  // m
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    const uint number = push.firstNumber + i, slot = slots.data[number];
    if (slot == NO_SIDE) return;
    patchSurfels.data[slot] = PatchSurfel(s.position, number, s.normal, s.id, s.reflectance, s.voxel, NO_SIDE, 0.5 * push.voxelSize,
                                          s.area == 0.0 ? 1u : 0u);
}
