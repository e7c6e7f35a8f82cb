// Moves the irradiance of surfels to their places among those of their sides. A thread takes a surfel of a chunk.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SurfelValues { vec3 data[]; };
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;
layout(scalar) readonly buffer PlacesAt { LargeUints places; };
layout(scalar) readonly buffer PlacedAt { SurfelValues placed; };
layout(push_constant) uniform Push {
    uint count;
    uint firstNumber;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const uint place = places.data[push.firstNumber + i];
    if (place != NO_SIDE) placed.data[place] = direct.data[i].rgb;
}
