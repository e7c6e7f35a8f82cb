// Moments of the distance of surfaces in the direction of each texel of a batch of probes: means over the rays, weighted
// by a power of their cosine, blended with those of earlier updates. Back faces count with a fifth of their distance, so
// that hardly any light gets through them. Source: Majercik et al. 2019, section 4; Majercik et al. 2021, section 4.1.
#include "passes/probes/update_probes/probe_texel.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer DepthHistory { vec2 data[]; } depthHistory;
layout(rg16f) uniform writeonly image3D depth;
layout(push_constant) uniform Push {
    uint first;  // Of the batch, in the list.
    uint count;
    uint raysPerProbe;
    float hysteresis;  // Part of earlier updates; 0: none.
    float sharpness;
} push;

void main() {
    const uint n = probeGrids.settings.depthTexels, i = linearIndex();
    if (i >= push.count * n * n) return;
    const ProbeTexel t = probeTexel(i, push.first, n);
    const float minCosine = pow(1e-6, 1.0 / push.sharpness);  // Weights below are left out; 2019 has 1e-3.
    vec2 sum = vec2(0.0);
    float weights = 0.0, nearest = -1.0, nearestDistance = 0.0;
    for (uint r = 0u; r < push.raysPerProbe; ++r) {
        const float cosine = dot(directions.data[r], t.direction);
        if (cosine < minCosine && cosine <= nearest) continue;
        const float signed_ = light.data[t.inBatch * push.raysPerProbe + r].w;
        const float distance_ = signed_ < 0.0 ? -0.2 * signed_ : signed_;
        if (cosine > nearest) {
            nearest = cosine;
            nearestDistance = distance_;
        }
        if (cosine < minCosine) continue;
        const float weight = pow(cosine, push.sharpness);
        sum += weight * vec2(distance_, distance_ * distance_);
        weights += weight;
    }
    // Where no ray is near, that of the nearest
    const vec2 now = weights > 0.0 ? sum / weights : vec2(nearestDistance, nearestDistance * nearestDistance);
    const vec2 blended = push.hysteresis == 0.0 ? now : mix(now, depthHistory.data[t.stored], push.hysteresis);
    depthHistory.data[t.stored] = blended;
    STORE_PROBE_TEXEL(depth, t, n, vec4(blended, 0.0, 0.0))
}
