// Irradiance by cones at every so many-th surfel, in a place that its number picks: the order of surfels is any.
#include "passes/cones/radiance/cone_set.glsl"
#include "shaders/compute/linear_index.glsl"
#include "passes/surfels/surfel_types.h"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Surfels { Surfel data[]; } surfels;
layout(scalar) writeonly buffer Irradiance { vec4 data[]; } irradiance;  // W/m²; 1 where a point is.
layout(push_constant) uniform Push {
    uint count;      // Of surfels.
    uint stride;
    uint coneCount;  // Of a set.
    uint samples;    // Sets.
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const Surfel s = surfels.data[i];
    if (s.id % push.stride != 0u) return;
    const uint point = s.id / push.stride;
    if (point >= uint(irradiance.data.length())) return;
    // Of three numbers in [0, 1) those of one set complement those of the others: the additive recurrence of Roberts 2018.
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < push.samples; ++k) {
        const uint sample_ = (point * push.samples + k) & 0xffffu;
        const vec3 dither = fract(vec3(0.5) + float(sample_) * vec3(0.819172513, 0.671043607, 0.549700478));
        sum += coneIrradiance(s.position, s.normal, s.normal, push.coneCount, dither);
    }
    irradiance.data[point] = vec4(sum / float(push.samples), 1.0);
}
