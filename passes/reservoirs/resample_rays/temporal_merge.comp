// Temporal resampling: merges each ray's own hit with the reservoir of the previous frame.
#include "passes/reservoirs/merge.glsl"
#include "passes/reservoirs/moved_sample.glsl"
#include "passes/reservoirs/similar.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Receivers { Receiver data[]; } receivers;
layout(scalar) buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(scalar) readonly buffer PreviousReceivers { Receiver data[]; } previousReceivers;
layout(scalar) readonly buffer PreviousReservoirs { Reservoir data[]; } previousReservoirs;
layout(scalar) readonly buffer Neighbors { uint data[]; } neighbors;
#ifdef UNBIASED
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
#endif
layout(push_constant, scalar) uniform Push {
    uint firstRay;
    uint count;
    uint seed;
    uint hasMoved;  // Whether the scene has changed since the previous frame.
    float mMax;
} push;

// Balance heuristic of technique a with confidence weights, which pairwise weights are for a single neighbor.
float balance(float a, float b, float otherwise) { return a > 0.0 ? a / (a + b) : otherwise; }

void main() {
    const uint local = linearIndex();
    if (local >= push.count) return;
    const uint i = push.firstRay + local, before = neighbors.data[local];
    if (before == NO_RECEIVER) return;
    const Receiver receiver = receivers.data[i];
    const Reservoir own = reservoirs.data[i];
    const bool hasMoved = push.hasMoved != 0u;
    const Reservoir oldBefore = previousReservoirs.data[before];
    Reservoir old = sampleNow(oldBefore, hasMoved);
    const float scale = min(1.0, push.mMax / old.M);
    old.M *= scale;
    old.rays *= scale;
    const float M = own.M + old.M;

    const float ownHere = target(receiver, own), oldHere = target(receiver, old);
    float ownWeight = own.M / M, oldWeight = old.M / M;
    bool isOldVisible = true;
#ifdef UNBIASED
    const Receiver other = previousReceivers.data[before];
    const float ownThere = occluded.data[2u * local] == 0u ? target(other, sampleBefore(own, hasMoved)) : 0.0;
    ownWeight = balance(own.M * ownHere, old.M * ownThere, ownWeight);
    oldWeight = balance(old.M * target(other, oldBefore), own.M * oldHere, oldWeight);
    isOldVisible = occluded.data[2u * local + 1u] == 0u;
#endif

    Merge merge = startMerge();
    addCandidate(merge, own, ownWeight, ownHere, 0.0);
    const bool isOld = addCandidate(merge, old, oldWeight, oldHere, toUnit(randomBits(push.seed, i, 1u)));
    Reservoir result = endMerge(merge, isOld ? oldHere : ownHere, M);
    if (isOld && !isOldVisible) result.W = 0.0;
    reservoirs.data[i] = result;
}
