// For each probe the cumulative distribution of the bins in which the previous frame's probe of the same surface point
// received light, and over how many frames. All 0 where there was no such probe, or no light.
#include "passes/final_gather/gather_screen_probes/probe_bins.glsl"
#include "passes/final_gather/gather_screen_probes/screen_probes.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kBinEdge = 8u;

uniform sampler2D motion;
uniform sampler2D previous;
layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
layout(scalar) readonly buffer OldProbes { ScreenProbe data[]; } oldProbes;
readonly buffer OldFirstProbes { uint data[]; } oldFirstProbes;
// For each probe its bins, and then the number of frames.
layout(scalar) readonly buffer OldImportanceRef { LargeFloats oldImportance; };
layout(scalar) readonly buffer DistributionRef { LargeFloats distribution; };
layout(push_constant, scalar) uniform Push {
    ProbeTiles tiles;
    uint count;
    uint hasHistory;
} push;

#define NO_PROBE 0xffffffffu

// The nearest probe on the surface that the texel showed.
uint oldProbeOf(ScreenProbe probe) {
    const ivec2 texel = unpackTexel(probe.texel);
    const vec3 point = texelFetch(previous, texel, 0).xyz, n = fromOctahedral(probe.faceNormal);
    const vec2 place = vec2(texel) + texelFetch(motion, texel, 0).xy;
    if (any(lessThan(place, vec2(-0.5))) || any(greaterThanEqual(place, vec2(push.tiles.texels) - 0.5))) return NO_PROBE;
    ivec2 first, last;
    tilesAround(push.tiles, ivec2(place + 0.5) / int(push.tiles.edge), first, last);
    uint best = NO_PROBE;
    float most = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint tile = uint(y) * push.tiles.tiles.x + uint(x);
            for (uint k = oldFirstProbes.data[tile]; k < oldFirstProbes.data[tile + 1u]; ++k) {
                const ScreenProbe old = oldProbes.data[k];
                if (old.instance != probe.instance) continue;
                const float weight = screenWeight(vec2(unpackTexel(old.texel)) - place, float(push.tiles.edge)) *
                                     surfaceWeight(point, n, old, old.width);
                if (weight > most) {
                    most = weight;
                    best = k;
                }
            }
        }
    return best;
}

void main() {
    const uint i = linearIndex(), bins = kBinEdge * kBinEdge;
    if (i >= push.count) return;
    const uint old = push.hasHistory != 0u ? oldProbeOf(probes.data[i]) : NO_PROBE;
    const uint from = old * (bins + 1u), to = i * (bins + 1u);
    float total = 0.0;
    if (old != NO_PROBE)
        for (uint b = 0u; b < bins; ++b) total += oldImportance.data[from + b];
    float sum = 0.0;
    for (uint b = 0u; b < bins; ++b) {
        if (total > 0.0) sum += oldImportance.data[from + b];
        distribution.data[to + b] = total > 0.0 ? (b + 1u == bins ? 1.0 : min(sum / total, 1.0)) : 0.0;
    }
    distribution.data[to + bins] = total > 0.0 ? oldImportance.data[from + bins] : 0.0;
}
