// Adds what shadow rays carry to the surfels that they reach.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Carried { vec4 data[]; } carried;
readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) buffer Direct { vec4 data[]; } direct;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.count && occluded.data[i] == 0u) direct.data[i] += carried.data[i];
}
