// Stores the irradiance of a range of surfels.
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
layout(scalar) readonly buffer SurfelIrradianceRef { SurfelValues surfelIrradiance; };
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i < push.count) surfelIrradiance.data[push.first + i] = direct.data[i].rgb;
}
