#version 460
#extension GL_GOOGLE_include_directive : require
// Fixed-point sums to watts.
#include "shaders/voxels/flux_accumulator.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer FluxAt { LargeFloats flux; };
layout(push_constant) uniform Push {
    uint count;
    float wattsPerUnit;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) flux.data[i] = float(fluxAccumulator.data[i]) * push.wattsPerUnit;
}
