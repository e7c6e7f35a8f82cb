// Sides that something hides are no neighbours. KEEP: of some it is known from the last build, whose lists they have, by other numbers.
// A thread takes a pair.
#include "passes/clusters/patch_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer NeighboursAt { LargeUints neighbours; };
#ifdef KEEP
layout(scalar) readonly buffer WhoseAt { LargeUints whose; };
readonly buffer FirstNeighbour { uint data[]; } firstNeighbour;
readonly buffer PairsFrom { uint data[]; } pairsFrom;
readonly buffer FirstNeighbourBefore { uint data[]; } firstNeighbourBefore;
layout(scalar) readonly buffer NeighboursBeforeAt { LargeUints neighboursBefore; };
#endif
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

bool isHidden(uint i) {
#ifdef KEEP
    const uint side = whose.data[push.first + i], previous = pairsFrom.data[side];
    if (previous != NO_SIDE) {
        const uint at = push.first + i - firstNeighbour.data[side];
        return neighboursBefore.data[firstNeighbourBefore.data[previous] + at] == NO_SIDE;
    }
#endif
    return occluded.data[i] != 0u;
}

void main() {
    const uint i = linearIndex();
    if (i < push.count && isHidden(i)) neighbours.data[push.first + i] = NO_SIDE;
}
