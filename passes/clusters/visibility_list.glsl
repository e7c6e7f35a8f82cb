// Iterates over a patch's visibility list:
// for (VisibilityListIterator it = visibilityListOf(lists, patch); nextEntry(lists, it);).
#ifndef VOXRAY_VISIBILITY_LIST_GLSL
#define VOXRAY_VISIBILITY_LIST_GLSL

#include "passes/clusters/visibility_list_types.h"
#include "shaders/compute/large_buffer.glsl"

struct VisibilityListChunk {
    LargeUints offsets;  // First entry of each patch; then the end of the last list.
    LargeUints entries;
};
layout(scalar) readonly buffer VisibilityListChunks { VisibilityListChunk data[]; } visibilityLists;

// Reads each word once: on software Vulkan reads are most of the cost.
struct VisibilityListIterator {
    uint entry;  // For entryTarget() and entryRays().
    uint remaining;
    LargeUints entries;
    uint word;        // Index of the current word.
    uint unread;      // Its bits that have not been decoded yet.
    uint unreadBits;  // Their number.
};

uint shiftRight(uint word, uint bits) { return bits < 32u ? word >> bits : 0u; }

VisibilityListIterator visibilityListOf(VisibilityListLayout lists, uint patchNumber) {
    VisibilityListChunk chunk = visibilityLists.data[patchNumber / lists.patchesPerChunk];
    const uint i = patchNumber % lists.patchesPerChunk, first = chunk.offsets.data[i], bit = first * lists.entryBits;
    VisibilityListIterator it;
    it.remaining = chunk.offsets.data[i + 1u] - first;
    it.entries = chunk.entries;
    it.word = bit / 32u;
    it.unreadBits = 32u - bit % 32u;
    it.unread = 0u;
    if (it.remaining > 0u) it.unread = chunk.entries.data[it.word] >> bit % 32u;
    return it;
}

bool nextEntry(VisibilityListLayout lists, inout VisibilityListIterator it) {
    if (it.remaining == 0u) return false;
    --it.remaining;
    const uint entryBits = lists.entryBits;
    uint entry = it.unread;
    if (it.unreadBits < entryBits) {
        const uint next = it.entries.data[++it.word];
        entry |= next << it.unreadBits;
        it.unread = shiftRight(next, entryBits - it.unreadBits);
        it.unreadBits += 32u;
    } else {
        it.unread = shiftRight(it.unread, entryBits);
    }
    it.unreadBits -= entryBits;
    it.entry = bitfieldExtract(entry, 0, int(entryBits));
    return true;
}

#endif
