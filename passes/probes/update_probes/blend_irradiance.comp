// Irradiance of each texel of a batch of probes: pi times the mean radiance of the rays, weighted by their cosine, blended
// with that of earlier updates. Source: Majercik et al. 2019, section 4; Majercik et al. 2021, sections 4.2 (encoding) and
// 4.3 (thresholds).
#include "passes/probes/update_probes/probe_texel.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer IrradianceHistory { vec3 data[]; } irradianceHistory;  // Encoded.
layout(rgba16f) uniform writeonly image3D irradiance;
layout(push_constant) uniform Push {
    uint first;  // Of the batch, in the list.
    uint count;
    uint raysPerProbe;
    float hysteresis;  // Part of earlier updates; 0: none.
    float changeThreshold;
    float resetThreshold;
} push;

float largest(vec3 v) { return max(v.x, max(v.y, v.z)); }

// Hysteresis of a texel, lower where it changes: by the change of encoded values over the larger of both.
float hysteresisOf(vec3 old, vec3 encoded) {
    if (push.hysteresis == 0.0) return 0.0;
    const float change = largest(abs(encoded - old)) / max(max(largest(old), largest(encoded)), 1e-20);
    if (change > push.resetThreshold) return 0.0;
    return change > push.changeThreshold ? max(push.hysteresis - 0.15, 0.0) : push.hysteresis;
}

void main() {
    const uint n = probeGrids.settings.irradianceTexels, i = linearIndex();
    if (i >= push.count * n * n) return;
    const ProbeTexel t = probeTexel(i, push.first, n);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (uint r = 0u; r < push.raysPerProbe; ++r) {
        const vec4 light_ = light.data[t.inBatch * push.raysPerProbe + r];
        const float weight = light_.w < 0.0 ? 0.0 : max(dot(directions.data[r], t.direction), 0.0);
        sum += weight * light_.rgb;
        weights += weight;
    }
    const vec3 now = weights > 0.0 ? PI * sum / weights : vec3(0.0);
    const vec3 encoded = pow(now / probeGrids.settings.unit, vec3(1.0 / probeGrids.settings.encodingGamma));
    const vec3 old = push.hysteresis == 0.0 ? encoded : irradianceHistory.data[t.stored];
    const vec3 blended = mix(encoded, old, hysteresisOf(old, encoded));
    irradianceHistory.data[t.stored] = blended;
    vec3 rounded;
    for (uint c = 0u; c < 3u; ++c) rounded[c] = roundedToHalf(blended[c], hashCombine(t.stored, c));
    STORE_PROBE_TEXEL(irradiance, t, n, vec4(rounded, 1.0))
}
