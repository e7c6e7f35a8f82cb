// Removes candidates for neighbors that are occluded. UPDATE: uses the previous result for groups with unchanged
// neighborhoods, where the neighbors have the same bytes.
#ifdef UPDATE
#include "passes/clusters/neighbors.glsl"
#else
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/large_buffer.glsl"
#endif
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer CandidatesRef { LargeUints candidates; };
#ifdef UPDATE
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
layout(scalar) readonly buffer GroupOfCandidateRef { LargeUints groupOfCandidate; };
readonly buffer ReusablePreviousIndex { uint data[]; } reusablePreviousIndex;
readonly buffer PreviousFirstNeighbor { uint data[]; } previousFirstNeighbor;
layout(scalar) readonly buffer PreviousNeighborsRef { LargeUints previousNeighbors; };
#endif
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

bool isOccludedCandidate(uint i) {
#ifdef UPDATE
    const uint group = groupOfCandidate.data[push.first + i], previous = reusablePreviousIndex.data[group];
    if (previous != NO_GROUP) {
        const uint candidate = candidates.data[push.first + i];
        const uint code = neighborCode(groups.data[group], groups.data[candidate], candidate);
        for (uint k = previousFirstNeighbor.data[previous]; k < previousFirstNeighbor.data[previous + 1u]; ++k)
            if (byteOf(previousNeighbors.data[k / 4u], k) == code) return false;
        return true;
    }
#endif
    return occluded.data[i] != 0u;
}

void main() {
    const uint i = linearIndex();
    if (i < push.count && isOccludedCandidate(i)) candidates.data[push.first + i] = NO_GROUP;
}
