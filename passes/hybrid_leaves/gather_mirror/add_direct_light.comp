// Adds the direct light that surfels reflect to the light of their paths.
#include "passes/hybrid_leaves/gather_mirror/mirror_types.h"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) readonly buffer SurfelIrradiance { vec4 data[]; } surfelIrradiance;  // W/m²
layout(scalar) buffer Light { MirrorLight data[]; } light;
layout(push_constant) uniform Push { uint count; } push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    light.data[s.parent].indirect += s.reflectance * surfelIrradiance.data[i].rgb;
}
