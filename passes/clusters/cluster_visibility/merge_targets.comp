// Sorts the targets of each patch's rays (heapsort) and merges equal ones into entries of its visibility list.
#include "passes/clusters/visibility_list_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

// Input: raysPerPatch targets for each patch. Output: the first elements of each patch are its entries.
layout(scalar) buffer Targets { uint data[]; } targets;
// One for each patch, and a last 0, where the prefix sum leaves the total.
layout(scalar) writeonly buffer EntryCounts { uint data[]; } entryCounts;
layout(push_constant, scalar) uniform Push {
    VisibilityListLayout listLayout;
    uint patchCount;
} push;

// Restores the order of a max-heap of `count` targets in which element `node` may be too small.
void siftDown(uint first, uint node, uint count) {
    const uint moved = targets.data[first + node];
    for (uint child = 2u * node + 1u; child < count; child = 2u * node + 1u) {
        if (child + 1u < count && targets.data[first + child + 1u] > targets.data[first + child]) ++child;
        if (targets.data[first + child] <= moved) break;
        targets.data[first + node] = targets.data[first + child];
        node = child;
    }
    targets.data[first + node] = moved;
}

void heapSort(uint first, uint count) {
    for (uint node = count / 2u; node > 0u; --node) siftDown(first, node - 1u, count);
    for (uint end = count - 1u; end > 0u; --end) {
        const uint last = targets.data[first + end];
        targets.data[first + end] = targets.data[first];
        targets.data[first] = last;
        siftDown(first, 0u, end);
    }
}

void main() {
    const uint number = linearIndex();
    if (number > push.patchCount) return;
    uint entries = 0u;
    if (number < push.patchCount) {
        const uint first = number * push.listLayout.raysPerPatch;
        heapSort(first, push.listLayout.raysPerPatch);
        uint target = targets.data[first], rays = 0u;
        for (uint i = 0u; i < push.listLayout.raysPerPatch && target != NO_TARGET; ++i) {
            const uint next = targets.data[first + i];
            if (next == target) {
                ++rays;
                continue;
            }
            targets.data[first + entries++] = packEntry(push.listLayout, target, rays);
            target = next;
            rays = 1u;
        }
        if (target != NO_TARGET) targets.data[first + entries++] = packEntry(push.listLayout, target, rays);
    }
    entryCounts.data[number] = entries;
}
