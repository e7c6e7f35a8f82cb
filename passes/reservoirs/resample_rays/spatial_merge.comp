// Spatial resampling: each receiver's irradiance from one sample out of its own reservoir and those of its neighbors,
// by pairwise multiple importance sampling (Bitterli 2021, section 9.1.3) with confidence weights (Lin et al. 2022).
#include "passes/reservoirs/merge.glsl"
#include "passes/reservoirs/similar.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Receivers { Receiver data[]; } receivers;
layout(scalar) readonly buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(scalar) readonly buffer Neighbors { uint data[]; } neighbors;
#ifdef UNBIASED
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
#endif
// Irradiance if nothing hides the sample, W/m²; independent rays, -1 without a surface.
layout(scalar) writeonly buffer Resampled { vec4 data[]; } resampled;
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;  // From the receiver to its sample.
layout(push_constant, scalar) uniform Push {
    uint firstRay;
    uint count;
    uint seed;
    uint neighborCount;
} push;

void main() {
    const uint local = linearIndex(), first = local * push.neighborCount;
    if (local >= push.count) return;
    const uint i = push.firstRay + local;
    const Receiver receiver = receivers.data[i];
    if (receiver.distance_ <= 0.0) {
        resampled.data[local] = vec4(vec3(0.0), -1.0);
        rays.data[local] = kNoRay;
        return;
    }
    float neighborM = 0.0;
    for (uint n = 0u; n < push.neighborCount; ++n)
        if (neighbors.data[first + n] != NO_RECEIVER) neighborM += reservoirs.data[neighbors.data[first + n]].M;

    // Merge the neighbors' samples, each with the weight of the pair of its receiver and this one
    const Reservoir own = reservoirs.data[i];
    const float M = own.M + neighborM, ownHere = target(receiver, own);
    float ownWeight = neighborM > 0.0 && ownHere > 0.0 ? 0.0 : own.M / M;
    bool isOwn = true;
    float chosenHere = ownHere;
    Merge merge = startMerge();
    for (uint n = 0u; n < push.neighborCount; ++n) {
        const uint neighbor = neighbors.data[first + n];
        if (neighbor == NO_RECEIVER) continue;
        const Reservoir y = reservoirs.data[neighbor];
        const float here = target(receiver, y);
        float weight = y.M / M;
#ifdef UNBIASED
        const Receiver other = receivers.data[neighbor];
        const float there = neighborM * target(other, y);
        if (there > 0.0) weight = y.M * there / (neighborM * (there + own.M * here));
        const float ownThere = occluded.data[first + n] == 0u ? neighborM * target(other, own) : 0.0;
        if (ownHere > 0.0) ownWeight += y.M / neighborM * own.M * ownHere / (own.M * ownHere + ownThere);
#endif
        if (addCandidate(merge, y, weight, here, toUnit(randomBits(push.seed, i, 4096u + n)))) {
            isOwn = false;
            chosenHere = here;
        }
    }
#ifndef UNBIASED
    ownWeight = own.M / M;
#endif
    if (addCandidate(merge, own, ownWeight, ownHere, toUnit(randomBits(push.seed, i, 2u)))) {
        isOwn = true;
        chosenHere = ownHere;
    }

    const Reservoir result = endMerge(merge, chosenHere, M);
    const float geometry = geometryTerm(receiver, result);
    resampled.data[local] = vec4(result.light * (geometry * result.W / PI), result.rays);
    const bool isTested = !isOwn && result.W > 0.0 && geometry > 0.0;
    rays.data[local] = isTested ? visibilityRay(receiver, result) : kNoRay;
}
