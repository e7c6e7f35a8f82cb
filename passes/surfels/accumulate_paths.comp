// Adds what arrives at the ends of paths, and is reflected along them, to the irradiance where they began: one path each.
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Ends { Surfel data[]; } ends;
layout(scalar) readonly buffer Arriving { vec4 data[]; } arriving;  // W/m²
layout(scalar) buffer Irradiance { vec4 data[]; } irradiance;       // W/m²
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = ends.data[i];
    irradiance.data[s.parent] += vec4(s.reflectance * arriving.data[i].rgb, 0.0);
}
