// Sums what a probe's rays bring by bins of directions.
#include "passes/final_gather/gather_screen_probes/equal_area_octahedron.glsl"
#include "passes/final_gather/gather_screen_probes/probe_bins.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kBinEdge = 8u;

layout(scalar) readonly buffer Rays { Ray data[]; } rays;
layout(scalar) readonly buffer Hits { Hit data[]; } hits;
layout(scalar) readonly buffer Weights { float data[]; } weights;
layout(scalar) readonly buffer Light { vec4 data[]; } light;
layout(scalar) readonly buffer BinsRef { ProbeBins bins; };
layout(push_constant) uniform Push {
    uint firstProbe;
    uint count;
    uint raysPerProbe;
} push;

void main() {
    const uint i = linearIndex(), binCount = kBinEdge * kBinEdge;
    if (i >= push.count) return;
    const uint first = (push.firstProbe + i) * binCount;
    for (uint b = 0u; b < binCount; ++b) bins.data[first + b] = vec4(0.0);
    for (uint j = i * push.raysPerProbe; j < (i + 1u) * push.raysPerProbe; ++j) {
        if (weights.data[j] == 0.0) continue;
        const uint bin = first + binOf(rays.data[j].direction, kBinEdge);
        const vec4 sum = bins.data[bin];
        const bool isHit = hits.data[j].triangle != NO_HIT;
        const float inverse = isHit ? 1.0 / max(hits.data[j].t, 1.0e-6) : 0.0;
        bins.data[bin] = vec4(sum.rgb + weights.data[j] * light.data[j].rgb, max(sum.w, inverse));
    }
}
