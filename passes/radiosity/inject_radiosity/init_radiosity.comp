// Initial radiosity of surfels: their reflected direct irradiance.
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/radiosity.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;  // W/m²
layout(scalar) readonly buffer RadiosityRef { LargeUints radiosity; };
layout(push_constant) uniform Push {
    uint count;
    uint firstSurfel;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    radiosity.data[push.firstSurfel + i] = packRadiosity(surfels.data[i].reflectance * direct.data[i].rgb);
}
