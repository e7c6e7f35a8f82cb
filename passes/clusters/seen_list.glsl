// What a patch sees, entry by entry: for (SeenWalk w = walkSeen(lists, patch); nextSeen(lists, w);) w.entry ...
#ifndef VOXRAY_SEEN_LIST_GLSL
#define VOXRAY_SEEN_LIST_GLSL

#include "passes/clusters/seen_types.h"
#include "shaders/compute/large_buffer.glsl"

struct SeenChunk {
    LargeUints first;  // Where each patch's list begins, and where the last one ends.
    LargeUints seen;
};
layout(scalar) readonly buffer SeenChunks { SeenChunk data[]; } seenChunks;

// Each word is read once, for on software Vulkan reads are what a list costs: what is left of it waits for the next entry.
struct SeenWalk {
    uint entry;    // seenTarget() and seenRays() tell of it.
    uint entries;  // That are still to come.
    LargeUints seen;
    uint word;  // The number of the word in hand,
    uint left;  // its bits that are still to come,
    uint held;  // and how many they are.
};

uint shiftedRight(uint word, uint bits) { return bits < 32u ? word >> bits : 0u; }

SeenWalk walkSeen(SeenLayout lists, uint number) {
    SeenChunk chunk = seenChunks.data[number / lists.patchesPerChunk];
    const uint i = number % lists.patchesPerChunk, begin = chunk.first.data[i], bit = begin * lists.entryBits;
    SeenWalk w;
    w.entries = chunk.first.data[i + 1u] - begin;
    w.seen = chunk.seen;
    w.word = bit / 32u;
    w.held = 32u - bit % 32u;
    w.left = 0u;
    if (w.entries > 0u) w.left = chunk.seen.data[w.word] >> bit % 32u;
    return w;
}

bool nextSeen(SeenLayout lists, inout SeenWalk w) {
    if (w.entries == 0u) return false;
    --w.entries;
    const uint bits = lists.entryBits;
    uint entry = w.left;
    if (w.held < bits) {
        const uint next = w.seen.data[++w.word];
        entry |= next << w.held;
        w.left = shiftedRight(next, bits - w.held);
        w.held += 32u;
    } else {
        w.left = shiftedRight(w.left, bits);
    }
    w.held -= bits;
    w.entry = bitfieldExtract(entry, 0, int(bits));
    return true;
}

#endif
