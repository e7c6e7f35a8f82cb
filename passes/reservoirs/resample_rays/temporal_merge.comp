// Temporal resampling: merges each ray's own hit with the reservoir of the previous frame.
#include "passes/reservoirs/changed_regions.glsl"
#include "passes/reservoirs/merge.glsl"
#include "passes/reservoirs/moved_sample.glsl"
#include "passes/reservoirs/similar.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

#ifdef UNBIASED
uniform sampler2D position;
uniform sampler2D previous;
#endif
layout(scalar) readonly buffer Receivers { Receiver data[]; } receivers;
layout(scalar) buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(scalar) readonly buffer PreviousReceivers { Receiver data[]; } previousReceivers;
layout(scalar) readonly buffer PreviousReservoirs { Reservoir data[]; } previousReservoirs;
layout(scalar) readonly buffer Neighbors { uint data[]; } neighbors;
#ifdef UNBIASED
layout(scalar) readonly buffer Occluded { uint data[]; } occluded;
#endif
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstRay;
    uint count;
    uint seed;
    uint hasMoved;  // Whether the scene has changed since the previous frame.
    uint changedRegions;  // Their number.
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
    const Reservoir oldBefore = previousReservoirs.data[before];
    Reservoir old = oldBefore;
    const bool oldMoved = push.hasMoved != 0u && old.W > 0.0 && hasMoved(old);
    if (oldMoved) old = sampleNow(old);
    const float scale = min(1.0, push.mMax / old.M);
    old.M *= scale;
    old.rays *= scale;
    const float M = own.M + old.M;

    const float ownHere = target(receiver, own), oldHere = target(receiver, old);
    float ownWeight = own.M / M, oldWeight = old.M / M;
    bool isOldVisible = true;
#ifdef UNBIASED
    const Receiver other = previousReceivers.data[before];
    const bool ownMoved = push.hasMoved != 0u && own.W > 0.0 && hasMoved(own);
    float ownThere = occluded.data[2u * local] == 0u ? target(other, ownMoved ? sampleBefore(own) : own) : 0.0;
    float oldThere = target(other, oldBefore);

    // Between what stands still, the previous frame may not have seen a sample past something that moves
    if (push.changedRegions > 0u && standsStill(position, previous, texelOfReceiver(push.layout_, i))) {
        if (!ownMoved && crossesChange(receiver.origin, own.position, push.changedRegions)) ownThere = 0.0;
        if (!oldMoved && crossesChange(receiver.origin, old.position, push.changedRegions)) oldThere = 0.0;
    }
    ownWeight = balance(own.M * ownHere, old.M * ownThere, ownWeight);
    oldWeight = balance(old.M * oldThere, own.M * oldHere, oldHere > 0.0 ? 0.0 : oldWeight);
    isOldVisible = occluded.data[2u * local + 1u] == 0u;
#endif

    Merge merge = startMerge();
    addCandidate(merge, own, ownWeight, ownHere, 0.0);
    const bool isOld = addCandidate(merge, old, oldWeight, oldHere, toUnit(randomBits(push.seed, i, 1u)));
    Reservoir result = endMerge(merge, isOld ? oldHere : ownHere, M);
    if (isOld && !isOldVisible) result.W = 0.0;
    reservoirs.data[i] = result;
}
