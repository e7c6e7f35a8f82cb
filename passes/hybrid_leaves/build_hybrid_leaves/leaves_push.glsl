// Push constants of shaders with one invocation per leaf.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint leaves;
    uint capacity;  // Maximum triangles of a list.
} push;
