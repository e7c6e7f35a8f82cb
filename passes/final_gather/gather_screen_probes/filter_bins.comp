// Averages each bin of a probe's directions over the probes around that are on its surface and see the same there: a
// neighbor counts the less, the more the nearest hit's direction differs between both, over the width of a bin.
#include "passes/final_gather/gather_screen_probes/screen_probes.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/scene/sampling.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kBinEdge = 8u;

layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
readonly buffer FirstProbes { uint data[]; } firstProbes;
layout(scalar) readonly buffer Bins { vec4 data[]; } bins;
layout(scalar) writeonly buffer Filtered { vec4 data[]; } filtered;
layout(push_constant, scalar) uniform Push {
    ProbeTiles tiles;
    uint count;
} push;

void main() {
    const uint i = linearIndex(), binCount = kBinEdge * kBinEdge;
    if (i >= push.count * binCount) return;
    const ScreenProbe probe = probes.data[i / binCount];
    const vec3 n = fromOctahedral(probe.faceNormal);
    const ivec2 texel = unpackTexel(probe.texel);
    const float binWidth = sqrt(4.0 * PI / float(binCount));
    const vec4 own = bins.data[i];
    ivec2 first, last;
    tilesAround(push.tiles, texel / int(push.tiles.edge), first, last);
    vec3 sum = vec3(0.0);
    float total = 0.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint tile = uint(y) * push.tiles.tiles.x + uint(x);
            for (uint k = firstProbes.data[tile]; k < firstProbes.data[tile + 1u]; ++k) {
                const vec2 away = vec2(unpackTexel(probes.data[k].texel) - texel);
                float weight = screenWeight(away, 2.0 * float(push.tiles.edge));
                if (weight <= 0.0) continue;
                weight *= surfaceWeight(probe.position, n, probes.data[k]);
                if (weight <= 0.0) continue;
                const vec4 bin = bins.data[k * binCount + i % binCount];
                const float parallax = distance(probe.position, probes.data[k].position) * max(own.w, bin.w);
                weight *= max(1.0 - parallax / binWidth, 0.0);
                sum += weight * bin.rgb;
                total += weight;
            }
        }
    filtered.data[i] = vec4(sum / total, own.w);
}
