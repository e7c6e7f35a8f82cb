// Counts the neighbors of each surface group: its candidates that were not removed. LIST: stores them.
#include "passes/clusters/neighbors.glsl"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

readonly buffer FirstCandidate { uint data[]; } firstCandidate;
layout(scalar) readonly buffer CandidatesRef { LargeUints candidates; };
#ifdef LIST
layout(scalar) readonly buffer Groups { SurfaceGroup data[]; } groups;
readonly buffer FirstNeighbor { uint data[]; } firstNeighbor;
layout(scalar) readonly buffer NeighborsRef { LargeUints neighbors; };  // Must be 0 before.
#else
// One for each group, and a last 0, where the prefix sum leaves the total.
writeonly buffer Counts { uint data[]; } counts;
#endif
layout(push_constant) uniform Push { uint groupCount; } push;

void main() {
    const uint group = linearIndex();
    if (group > push.groupCount) return;
    uint count = 0u;
    if (group < push.groupCount) {
        for (uint i = firstCandidate.data[group]; i < firstCandidate.data[group + 1u]; ++i) {
            const uint neighbor = candidates.data[i];
            if (neighbor == NO_GROUP) continue;
#ifdef LIST
            const uint position = firstNeighbor.data[group] + count;
            const uint code = neighborCode(groups.data[group], groups.data[neighbor], neighbor);
            // A word may hold neighbors of two groups
            atomicOr(neighbors.data[position / 4u], code << 8u * (position % 4u));
#endif
            ++count;
        }
    }
#ifndef LIST
    counts.data[group] = count;
#endif
}
