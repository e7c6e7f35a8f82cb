// Removes neighbors that are occluded from each other. UPDATE: copies the previous result for groups with unchanged
// neighborhoods, which have the same neighbors in the same order.
#include "passes/clusters/surface_group_types.h"
#include "shaders/compute/large_buffer.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer Occluded { uint data[]; } occluded;
layout(scalar) readonly buffer NeighborsRef { LargeUints neighbors; };
#ifdef UPDATE
layout(scalar) readonly buffer GroupOfEntryRef { LargeUints groupOfEntry; };
readonly buffer FirstNeighbor { uint data[]; } firstNeighbor;
readonly buffer ReusablePreviousIndex { uint data[]; } reusablePreviousIndex;
readonly buffer PreviousFirstNeighbor { uint data[]; } previousFirstNeighbor;
layout(scalar) readonly buffer PreviousNeighborsRef { LargeUints previousNeighbors; };
#endif
layout(push_constant) uniform Push {
    uint first;
    uint count;
} push;

bool isOccluded(uint i) {
#ifdef UPDATE
    const uint group = groupOfEntry.data[push.first + i], previous = reusablePreviousIndex.data[group];
    if (previous != NO_GROUP) {
        const uint indexInList = push.first + i - firstNeighbor.data[group];
        return previousNeighbors.data[previousFirstNeighbor.data[previous] + indexInList] == NO_GROUP;
    }
#endif
    return occluded.data[i] != 0u;
}

void main() {
    const uint i = linearIndex();
    if (i < push.count && isOccluded(i)) neighbors.data[push.first + i] = NO_GROUP;
}
