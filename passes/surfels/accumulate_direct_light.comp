// Adds the irradiance of shadow rays that reach their light.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Contributions { vec4 data[]; } contributions;  // W/m²
readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) buffer Direct { vec4 data[]; } direct;  // W/m²
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i < push.count && occluded.data[i] == 0u) direct.data[i] += contributions.data[i];
}
