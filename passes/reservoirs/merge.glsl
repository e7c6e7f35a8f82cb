// Weighted reservoir sampling over the candidates of one receiver. Source: Bitterli et al. 2020, section 3.
#ifndef VOXRAY_RESERVOIR_MERGE_GLSL
#define VOXRAY_RESERVOIR_MERGE_GLSL

#include "passes/reservoirs/reservoir.glsl"

struct Merge {
    Reservoir chosen;
    float sum;             // Of resampling weights.
    float misWeights;      // Sum of MIS weights, as far as they are known,
    float squaredWeights;  // and of their squares over the candidates' independent rays.
};

Merge startMerge() { return Merge(kNoSample, 0.0, 0.0, 0.0); }

// Adds a candidate with its MIS weight and the receiver's target function for it. `random`: in [0, 1). Returns whether
// it is chosen.
bool addCandidate(inout Merge merge, Reservoir y, float misWeight, float targetHere, float random) {
    merge.misWeights += misWeight;
    merge.squaredWeights += misWeight * misWeight / max(y.rays, 1e-6);
    const float weight = misWeight * targetHere * y.W;
    if (weight <= 0.0) return false;
    merge.sum += weight;
    const bool isChosen = random * merge.sum < weight;
    if (isChosen) merge.chosen = y;
    return isChosen;
}

// The result, for a receiver whose target function for the chosen sample is `targetHere`.
Reservoir endMerge(Merge merge, float targetHere, float M) {
    Reservoir result = merge.chosen;
    result.W = targetHere > 0.0 ? merge.sum / targetHere : 0.0;
    result.M = M;
    // A mean with weights m of independent values of r rays each has sum(m² / r) / sum(m)² of one ray's variance
    result.rays = merge.squaredWeights > 0.0 ? merge.misWeights * merge.misWeights / merge.squaredWeights : 1.0;
    return result;
}

#endif
