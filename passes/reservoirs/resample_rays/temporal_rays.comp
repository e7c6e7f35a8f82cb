// The previous frame's reservoir of each receiver, and the rays that tell what the two see of each other's samples.
#include "passes/reservoirs/changed_regions.glsl"
#include "passes/reservoirs/moved_sample.glsl"
#include "passes/reservoirs/similar.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

#ifdef UNBIASED
uniform sampler2D position;
#endif
uniform sampler2D motion;
uniform sampler2D previous;
layout(scalar) readonly buffer Receivers { Receiver data[]; } receivers;
layout(scalar) readonly buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(scalar) readonly buffer PreviousReceivers { Receiver data[]; } previousReceivers;
layout(scalar) readonly buffer PreviousReservoirs { Reservoir data[]; } previousReservoirs;
layout(scalar) writeonly buffer Neighbors { uint data[]; } neighbors;
// Two per receiver: from the previous receiver to the ray's own hit, and from the receiver to the previous sample.
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstRay;
    uint count;
    uint hasHistory;
    uint hasMoved;  // Whether the scene has changed since the previous frame.
    float minCosine;
    float depthThreshold;
} push;

// Not the depth alone, which a moved camera changes: the two points themselves are compared.
bool isSamePlace(Receiver here, vec3 place, Receiver before) {
    return distance(place, before.origin) <= push.depthThreshold * here.distance_;
}

void main() {
    const GatherLayout g = push.layout_;
    const uint local = linearIndex();
    if (local >= push.count) return;
    const uint i = push.firstRay + local;
    const Receiver receiver = receivers.data[i];
    uint before = NO_RECEIVER;
    if (push.hasHistory != 0u && receiver.distance_ > 0.0) {
        const ivec2 texel = texelOfReceiver(g, i);
        const ivec2 place = ivec2(floor(vec2(texel) + texelFetch(motion, texel, 0).xy + 0.5));
        before = receiverAt(g, place, i % g.raysPerBlock);
        if (before != NO_RECEIVER) {
            const Receiver other = previousReceivers.data[before];
            const bool similar = other.instance == receiver.instance &&
                                 haveSimilarNormals(receiver, other, push.minCosine) &&
                                 isSamePlace(receiver, texelFetch(previous, texel, 0).xyz, other);
            if (!similar) before = NO_RECEIVER;
        }
    }
    neighbors.data[local] = before;
#ifdef UNBIASED
    Ray toOwn = kNoRay, toPrevious = kNoRay;
    if (before != NO_RECEIVER) {
        const Receiver other = previousReceivers.data[before];
        const Reservoir own = reservoirs.data[i];
        Reservoir ownBefore = own, old = previousReservoirs.data[before];
        if (push.hasMoved != 0u && own.W > 0.0 && hasMoved(own)) ownBefore = sampleBefore(own);
        if (push.hasMoved != 0u && old.W > 0.0 && hasMoved(old)) old = sampleNow(old);

        // Where the previous receiver's surface has moved, no ray can start from it: now it may be inside of something.
        // It is taken to see what this receiver sees.
        const bool isStill = standsStill(position, previous, texelOfReceiver(g, i));
        if (own.W > 0.0 && isStill && geometryTerm(other, ownBefore) > 0.0) toOwn = visibilityRay(other, own);
        if (old.W > 0.0 && geometryTerm(receiver, old) > 0.0) toPrevious = visibilityRay(receiver, old);
    }
    rays.data[2u * local] = toOwn;
    rays.data[2u * local + 1u] = toPrevious;
#endif
}
