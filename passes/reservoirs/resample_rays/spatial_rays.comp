// Neighbors of each receiver, and the rays that tell which of them see its sample.
#include "passes/reservoirs/similar.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) readonly buffer Receivers { Receiver data[]; } receivers;
layout(scalar) readonly buffer Reservoirs { Reservoir data[]; } reservoirs;
layout(scalar) writeonly buffer Neighbors { uint data[]; } neighbors;  // Per receiver and neighbor; NO_RECEIVER: none.
layout(scalar) writeonly buffer Rays { Ray data[]; } rays;             // Likewise, from the neighbor.
layout(push_constant, scalar) uniform Push {
    GatherLayout layout_;
    uint firstRay;
    uint count;
    uint seed;
    uint neighborCount;
    float radius;     // Texels.
    float minRadius;  // Texels.
    float minCosine;
    float depthThreshold;
} push;

uint similarNeighbor(Receiver receiver, uint i, ivec2 texel, float radius, uint number) {
    const uint bits = randomBits(push.seed, i, 16u + number);
    const float distance_ = radius * sqrt(toUnit(bits)), angle = 2.0 * PI * toUnit(hash(bits));
    const ivec2 place = texel + ivec2(round(distance_ * vec2(cos(angle), sin(angle))));
    const uint found = receiverAt(push.layout_, place, hash(bits ^ 0x9e3779b9u));
    if (found == NO_RECEIVER || found == i) return NO_RECEIVER;
    const Receiver other = receivers.data[found];
    const bool similar = haveSimilarNormals(receiver, other, push.minCosine) &&
                         abs(other.distance_ - receiver.distance_) <= push.depthThreshold * receiver.distance_;
    return similar ? found : NO_RECEIVER;
}

void main() {
    const uint local = linearIndex();
    if (local >= push.count) return;
    const uint i = push.firstRay + local;
    const Receiver receiver = receivers.data[i];
    const Reservoir own = reservoirs.data[i];
    const ivec2 texel = texelOfReceiver(push.layout_, i);
    float radius = push.radius;
    for (uint n = 0u; n < push.neighborCount; ++n) {
        // The radius is halved where a neighbor is unlike the receiver (Ouyang et al. 2021, section 5)
        const uint found = receiver.distance_ > 0.0 ? similarNeighbor(receiver, i, texel, radius, n) : NO_RECEIVER;
        if (found == NO_RECEIVER) radius = max(0.5 * radius, push.minRadius);
        neighbors.data[local * push.neighborCount + n] = found;
#ifdef UNBIASED
        Ray ray = kNoRay;
        if (found != NO_RECEIVER && own.W > 0.0) {
            const Receiver other = receivers.data[found];
            if (geometryTerm(other, own) > 0.0) ray = visibilityRay(other, own);
        }
        rays.data[local * push.neighborCount + n] = ray;
#endif
    }
}
