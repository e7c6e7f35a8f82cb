// The sum of each probe's filter weights, itself included, where nothing is near: filter_bins.comp divides by it.
#include "passes/final_gather/gather_screen_probes/screen_probes.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
readonly buffer FirstProbes { uint data[]; } firstProbes;
layout(scalar) writeonly buffer WeightSums { float data[]; } weightSums;
layout(push_constant, scalar) uniform Push {
    ProbeTiles tiles;
    uint count;
} push;

void main() {
    const uint i = linearIndex();
    if (i >= push.count) return;
    const ScreenProbe probe = probes.data[i];
    ivec2 first, last;
    tilesAround(push.tiles, unpackTexel(probe.texel) / int(push.tiles.edge), first, last);
    float sum = 1.0;
    for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) {
            const uint tile = uint(y) * push.tiles.tiles.x + uint(x);
            for (uint k = firstProbes.data[tile]; k < firstProbes.data[tile + 1u]; ++k) {
                if (k == i) continue;
                const float weight = neighborWeight(probe, probes.data[k].texel, push.tiles.edge);
                if (weight > 0.0) sum += weight * sharedSurface(probe, probes.data[k]);
            }
        }
    weightSums.data[i] = sum;
}
