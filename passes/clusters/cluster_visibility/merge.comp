// Sorts the targets of each patch's rays and merges equal ones: a thread takes a patch.
#include "passes/clusters/seen_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

layout(scalar) buffer Targets { uint data[]; } targets;  // By patch and ray; after it, of each patch first what it sees.
layout(scalar) writeonly buffer Counts { uint data[]; } counts;
layout(push_constant, scalar) uniform Push {
    SeenLayout lists;
    uint patches;
} push;

// Moves the target at `at` of a heap of `count` down to its place.
void sink(uint first, uint at, uint count) {
    const uint moved = targets.data[first + at];
    for (uint child = 2u * at + 1u; child < count; child = 2u * at + 1u) {
        if (child + 1u < count && targets.data[first + child + 1u] > targets.data[first + child]) ++child;
        if (targets.data[first + child] <= moved) break;
        targets.data[first + at] = targets.data[first + child];
        at = child;
    }
    targets.data[first + at] = moved;
}

void heapSort(uint first, uint count) {
    for (uint at = count / 2u; at > 0u; --at) sink(first, at - 1u, count);
    for (uint end = count - 1u; end > 0u; --end) {
        const uint last = targets.data[first + end];
        targets.data[first + end] = targets.data[first];
        targets.data[first] = last;
        sink(first, 0u, end);
    }
}

void main() {
    const uint number = linearIndex();
    if (number > push.patches) return;
    uint merged = 0u;
    if (number < push.patches) {
        const uint first = number * push.lists.raysPerPatch;
        heapSort(first, push.lists.raysPerPatch);
        uint target = targets.data[first], rays = 0u;
        for (uint i = 0u; i < push.lists.raysPerPatch && target != NO_TARGET; ++i) {
            const uint next = targets.data[first + i];
            if (next == target) {
                ++rays;
                continue;
            }
            targets.data[first + merged++] = packSeen(push.lists, target, rays);
            target = next;
            rays = 1u;
        }
        if (target != NO_TARGET) targets.data[first + merged++] = packSeen(push.lists, target, rays);
    }
    counts.data[number] = merged;  // One more than there are patches: where the last one ends.
}
