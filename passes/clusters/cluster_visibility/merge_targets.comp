// Sorts the targets of each patch's rays (heapsort), merges equal ones into entries of its visibility list, and finds the
// header and length of the packed list (visibility_list_types.h).
#include "passes/clusters/visibility_list_types.h"
#include "shaders/compute/linear_index.glsl"
layout(local_size_x = 64) in;

// Input: raysPerPatch targets for each patch. Output: the first elements of each patch are its entries, not packed.
layout(scalar) buffer Targets { uint data[]; } targets;
layout(scalar) writeonly buffer ListHeaders { uint data[]; } listHeaders;
// One for each patch, and a last 0, where the prefix sum leaves the total.
layout(scalar) writeonly buffer ListBits { uint data[]; } listBits;
buffer EntryCount { uint entryCount; };  // Of all lists.
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

// Merges sorted targets. @return the number of entries.
uint mergeEqual(uint first) {
    uint entries = 0u, target = targets.data[first], rays = 0u;
    for (uint i = 0u; i < push.listLayout.raysPerPatch && target != NO_TARGET; ++i) {
        const uint next = targets.data[first + i];
        if (next == target) {
            ++rays;
            continue;
        }
        targets.data[first + entries++] = unpackedEntry(push.listLayout, target, rays);
        target = next;
        rays = 1u;
    }
    if (target != NO_TARGET) targets.data[first + entries++] = unpackedEntry(push.listLayout, target, rays);
    return entries;
}

uint bitWidth(uint value) { return uint(findMSB(value) + 1); }

void main() {
    const uint number = linearIndex();
    if (number > push.patchCount) return;
    listBits.data[number] = 0u;
    if (number == push.patchCount) return;
    const uint first = number * push.listLayout.raysPerPatch;
    heapSort(first, push.listLayout.raysPerPatch);
    const uint entries = mergeEqual(first);
    if (entries == 0u) return;
    // Of the bitwise or of numbers the width is that of the largest
    uint differences = 1u, raysLess1 = 0u, previous = 0u;
    for (uint i = 0u; i < entries; ++i) {
        const uint entry = targets.data[first + i], target = entry >> push.listLayout.rayBits;
        differences |= target - previous;
        raysLess1 |= bitfieldExtract(entry, 0, int(push.listLayout.rayBits));
        previous = target;
    }
    const uint targetBits = bitWidth(differences), rayBits = bitWidth(raysLess1);
    listHeaders.data[number] = listHeader(targetBits, rayBits);
    listBits.data[number] = LIST_HEADER_BITS + entries * (targetBits + rayBits);
    atomicAdd(entryCount, entries);
}
