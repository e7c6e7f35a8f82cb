// Adds the direct light that the hits of probe rays reflect.
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer Direct { vec4 data[]; } direct;  // W/m²
layout(scalar) buffer Light { vec4 data[]; } light;
layout(push_constant) uniform Push { uint rayCount; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount || surfels.data[i].normal == vec3(0.0)) return;
    light.data[i].rgb += surfels.data[i].reflectance / PI * direct.data[i].rgb;
}
