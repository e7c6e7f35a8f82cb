// Iterates over a patch's visibility list:
// for (VisibilityListIterator it = visibilityListOf(lists, patch); nextEntry(it);).
#ifndef VOXRAY_VISIBILITY_LIST_GLSL
#define VOXRAY_VISIBILITY_LIST_GLSL

#include "passes/clusters/visibility_list_types.h"
#include "shaders/compute/large_buffer.glsl"

struct VisibilityListChunk {
    LargeUints offsets;  // First bit of each patch's list; then the end of the last one.
    LargeUints entries;
};
layout(scalar) readonly buffer VisibilityListChunks { VisibilityListChunk data[]; } visibilityLists;

// Reads each word once: on software Vulkan reads are most of the cost.
struct VisibilityListIterator {
    uint target;
    uint rays;       // That hit it.
    uint remaining;  // Entries.
    uint entryBits;
    uint rayBits;
    LargeUints entries;
    uint word;        // Index of the current word.
    uint unread;      // Its bits that have not been decoded yet.
    uint unreadBits;  // Their number.
};

uint shiftRight(uint word, uint bits) { return bits < 32u ? word >> bits : 0u; }

// `bits`: 1 to 32.
uint readBits(inout VisibilityListIterator it, uint bits) {
    uint value = it.unread;
    if (it.unreadBits < bits) {
        const uint next = it.entries.data[++it.word];
        value |= next << it.unreadBits;
        it.unread = shiftRight(next, bits - it.unreadBits);
        it.unreadBits += 32u;
    } else {
        it.unread = shiftRight(it.unread, bits);
    }
    it.unreadBits -= bits;
    return bitfieldExtract(value, 0, int(bits));
}

VisibilityListIterator visibilityListOf(VisibilityListLayout lists, uint patchNumber) {
    VisibilityListChunk chunk = visibilityLists.data[patchNumber / lists.patchesPerChunk];
    const uint i = patchNumber % lists.patchesPerChunk, first = chunk.offsets.data[i], end = chunk.offsets.data[i + 1u];
    VisibilityListIterator it;
    it.target = 0u;
    it.remaining = 0u;
    if (first == end) return it;
    it.entries = chunk.entries;
    it.word = first / 32u;
    it.unread = chunk.entries.data[it.word] >> first % 32u;
    it.unreadBits = 32u - first % 32u;
    const uint header = readBits(it, LIST_HEADER_BITS);
    it.rayBits = rayBitsOf(header);
    it.entryBits = targetBitsOf(header) + it.rayBits;
    it.remaining = (end - first - LIST_HEADER_BITS) / it.entryBits;
    return it;
}

bool nextEntry(inout VisibilityListIterator it) {
    if (it.remaining == 0u) return false;
    --it.remaining;
    const uint entry = readBits(it, it.entryBits);
    it.target += entry >> it.rayBits;
    it.rays = bitfieldExtract(entry, 0, int(it.rayBits)) + 1u;
    return true;
}

#endif
