// Rays of a batch of probes: by cosine about the probe's normal, and a part of them by where light came from in the
// previous frame. Each ray's weight is that of the balance heuristic (Veach 1997) between both.
#include "passes/final_gather/gather_screen_probes/equal_area_octahedron.glsl"
#include "passes/final_gather/gather_screen_probes/probe_bins.glsl"
#include "passes/final_gather/gather_screen_probes/screen_probes.glsl"
#include "shaders/compute/linear_index.glsl"
#include "shaders/trace/ray_types.h"
#include "shaders/view/gather_layout.glsl"
layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kBinEdge = 8u;

layout(scalar) readonly buffer Probes { ScreenProbe data[]; } probes;
readonly buffer FirstProbes { uint data[]; } firstProbes;
#ifdef HAS_HISTORY
layout(scalar) readonly buffer DistributionRef { LargeFloats distribution; };
#endif
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(scalar) writeonly buffer Weights { float data[]; } weights;  // Cosine over pi times the density of all rays.
layout(push_constant, scalar) uniform Push {
    ProbeTiles tiles;
    uint firstProbe;
    uint rayCount;
    uint raysPerProbe;
    uint guidedRays;  // Of each probe.
    uint seed;
} push;

#ifdef HAS_HISTORY
float below(uint first, uint bin) { return bin == 0u ? 0.0 : distribution.data[first + bin - 1u]; }

// The first bin whose cumulative probability is above u.
uint sampledBin(uint first, float u) {
    uint low = 0u, high = kBinEdge * kBinEdge - 1u;
    while (low < high) {
        const uint middle = (low + high) / 2u;
        if (distribution.data[first + middle] > u)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}

vec3 guidedDirection(uint first, vec2 u) {
    const uint bin = sampledBin(first, u.x);
    const float start = below(first, bin), share = distribution.data[first + bin] - start;
    u.x = share > 0.0 ? clamp((u.x - start) / share, 0.0, 1.0) : 0.5;
    return equalAreaDirection((vec2(bin % kBinEdge, bin / kBinEdge) + u) / float(kBinEdge));
}

// Density of guided rays by solid angle.
float guidedDensity(uint first, vec3 direction) {
    const uint bin = binOf(direction, kBinEdge);
    return (distribution.data[first + bin] - below(first, bin)) * float(kBinEdge * kBinEdge) / (4.0 * PI);
}
#endif

void main() {
    const uint i = linearIndex();
    if (i >= push.rayCount) return;
    const uint probeIndex = push.firstProbe + i / push.raysPerProbe, j = i % push.raysPerProbe;
    const ScreenProbe probe = probes.data[probeIndex];
    const vec3 n = fromOctahedral(probe.normal), faceNormal = fromOctahedral(probe.faceNormal);
    const uvec2 tile = uvec2(unpackTexel(probe.texel)) / push.tiles.edge;
    const uint seed = hashCombine(push.seed, probeIndex - firstProbes.data[tile.y * push.tiles.tiles.x + tile.x]);

    // Probes in Morton order take consecutive points of a sequence, as blocks of gather rays do
    uint guided = 0u;
#ifdef HAS_HISTORY
    const uint firstBin = probeIndex * (kBinEdge * kBinEdge + 1u);
    if (distribution.data[firstBin + kBinEdge * kBinEdge - 1u] > 0.0) guided = push.guidedRays;
#endif
    const uint byCosine = push.raysPerProbe - guided;
    vec3 direction = vec3(0.0);
    if (j < byCosine) direction = cosineDirection(sobol2(morton(tile) * byCosine + j, seed), n);
#ifdef HAS_HISTORY
    if (j >= byCosine) {
        const vec2 u = sobol2(morton(tile) * guided + j - byCosine, hashCombine(seed, 0x6d2b79f5u));
        direction = guidedDirection(firstBin, u);
    }
#endif
    const float cosine = dot(direction, n);
    Ray ray = kNoRay;
    float weight = 0.0;
    if (cosine > 0.0 && dot(direction, faceNormal) > 0.0) {
        float density = float(byCosine) * cosine;
#ifdef HAS_HISTORY
        if (guided > 0u) density += float(guided) * PI * guidedDensity(firstBin, direction);
#endif
        ray = Ray(probe.position + faceNormal * probe.offset, 0.0, direction, 1.0e30);
        weight = cosine / density;
    }
    rays.data[i] = ray;
    weights.data[i] = weight;
}
