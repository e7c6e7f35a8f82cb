#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_scalar_block_layout : require
// Fixed-point sums to watts.
#include "shaders/linear_index.glsl"
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer Sums { uint64_t data[]; } sums;
layout(set = 0, binding = 1, scalar) writeonly buffer Flux { float data[]; } flux;
layout(push_constant) uniform Push {
    uint count;
    float wattsPerUnit;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) flux.data[i] = float(sums.data[i]) * push.wattsPerUnit;
}
