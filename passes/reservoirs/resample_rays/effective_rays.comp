// How many independent rays each block's resampled rays count as (docs/reservoirs.md). One number for a block: if it
// depended on a single ray's value, a mean weighted by it would be biased.
#include "passes/reservoirs/reservoir_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(scalar) readonly buffer Resampled { vec4 data[]; } resampled;
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) writeonly buffer EffectiveRays { float data[]; } effectiveRays;
layout(push_constant, scalar) uniform Push {
    uint firstRay;
    uint blocks;
    uint raysPerBlock;
    float shared_;  // Part of the rays in reach of reuse and filter that the filter's taps draw from in common.
} push;

void main() {
    const uint block = linearIndex();
    if (block >= push.blocks) return;
    float count = 0.0, reciprocals = 0.0, candidates = 0.0, lit = 0.0, visible = 0.0;
    for (uint j = 0u; j < push.raysPerBlock; ++j) {
        const uint local = block * push.raysPerBlock + j;
        const vec4 value = resampled.data[local];
        const float rays = value.w;
        if (rays < 0.0) continue;
        if (value.rgb != vec3(0.0)) {
            lit += 1.0;
            visible += occluded.data[local] == 0u ? 1.0 : 0.0;
        }
        count += 1.0;
        reciprocals += 1.0 / rays;
        candidates += reservoirs.data[push.firstRay + local].M;
    }
    if (count == 0.0 || visible == 0.0) {
        effectiveRays.data[block] = 1.0;
        return;
    }
    // Where only a part of the chosen hits are seen, as many values are left
    const float variance = reciprocals / count * lit / visible + push.shared_ * count / candidates;
    effectiveRays.data[block] = max(1.0 / variance, 1.0);
}
