// What shaders that take a leaf a thread are told.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(push_constant) uniform Push {
    uint leaves;
    uint capacity;  // Triangles of a list, at most.
} push;
