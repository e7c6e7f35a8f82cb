// Irradiance by cones at every `stride`-th surfel by id, stored by id, as surfels are in any order.
#include "passes/cones/radiance/cone_set.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Irradiance { vec4 data[]; } irradiance;  // W/m²; w: 1 where there is a point.
layout(push_constant) uniform Push {
    uint count;      // Surfels.
    uint stride;
    uint coneCount;  // Cones of a set.
    uint samples;    // Sets.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.id % push.stride != 0u) return;
    const uint point = s.id / push.stride;
    if (point >= uint(irradiance.data.length())) return;
    // Sets have low-discrepancy points in [0, 1)³ (additive recurrence, Roberts 2018)
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < push.samples; ++k) {
        const uint sample_ = (point * push.samples + k) & 0xffffu;
        const vec3 dither = fract(vec3(0.5) + float(sample_) * vec3(0.819172513, 0.671043607, 0.549700478));
        sum += coneIrradiance(s.position, s.normal, s.normal, push.coneCount, dither);
    }
    irradiance.data[point] = vec4(sum / float(push.samples), 1.0);
}
