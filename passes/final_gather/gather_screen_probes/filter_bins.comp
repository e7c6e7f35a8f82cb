// Averages each bin of a probe's directions over the probes around that are on its surface and see the same there: a
// neighbor counts the less, the more the nearest hit's direction differs between both, over the width of a bin. Two
// probes give each other the same part of their difference, so that the sum over all probes is kept, whatever weights
// have to do with light.
#include "passes/final_gather/gather_screen_probes/probe_bins.glsl"
#include "passes/final_gather/gather_screen_probes/screen_probes.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kBinEdge = 8u;

layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
readonly buffer FirstProbes { uint data[]; } firstProbes;
layout(scalar) readonly buffer WeightSums { float data[]; } weightSums;
layout(scalar) readonly buffer BinsRef { ProbeBins bins; };
layout(scalar) readonly buffer FilteredRef { ProbeBins filtered; };
layout(push_constant, scalar) uniform Push {
    ProbeTiles tiles;
    uint count;
} push;

void main() {
    const uint i = linearIndex(), binCount = kBinEdge * kBinEdge, index = i / binCount;
    if (i >= push.count * binCount) return;
    const ScreenProbe probe = probes.data[index];
    const float binWidth = sqrt(4.0 * PI / float(binCount)), ownSum = weightSums.data[index];
    const vec4 own = bins.data[i];
    ivec2 first, last;
    tilesAround(push.tiles, unpackTexel(probe.texel) / int(push.tiles.edge), first, last);
    vec3 light = own.rgb;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint tile = uint(y) * push.tiles.tiles.x + uint(x);
            for (uint k = firstProbes.data[tile]; k < firstProbes.data[tile + 1u]; ++k) {
                if (k == index) continue;
                float weight = neighborWeight(probe, probes.data[k].texel, push.tiles.edge);
                if (weight <= 0.0) continue;
                weight *= sharedSurface(probe, probes.data[k]) / max(ownSum, weightSums.data[k]);
                if (weight <= 0.0) continue;
                const vec4 bin = bins.data[k * binCount + i % binCount];
                const float parallax = distance(probe.position, probes.data[k].position) * max(own.w, bin.w);
                light += weight * max(1.0 - parallax / binWidth, 0.0) * (bin.rgb - own.rgb);
            }
        }
    filtered.data[i] = vec4(light, own.w);
}
