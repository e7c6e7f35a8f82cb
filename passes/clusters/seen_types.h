// What a patch sees: entries of a target and how many of the patch's rays met it. Shared by C++ and GLSL.
//
// Targets are faces of clusters' parts, 6 * part + face, and from 6 * parts on patches.
#ifndef VOXRAY_SHARED_SEEN_TYPES_H
#define VOXRAY_SHARED_SEEN_TYPES_H

#include "shaders/shared/types.h"

#ifdef __cplusplus
#define VOXRAY_SEEN_FUNCTION inline
#else
#define VOXRAY_SEEN_FUNCTION
#endif

VOXRAY_SHARED_BEGIN

#define NO_TARGET 0xffffffffu
#define SEEN_MAX_RAYS 1024u

// How lists are laid out. Those of patches are held in chunks, in which entries follow one another without a
// gap: bits 0 to entryBits - 1 of a chunk's words are the first entry.
struct SeenLayout {
    uint raysPerPatch;
    uint patchesPerChunk;
    uint sideTargets;  // Targets from here on are patches, before it faces of parts.
    uint rayBits;      // Of an entry's bits the lowest, the number of rays less one. The target is above it.
    uint entryBits;    // 1 to 32.
};

// `rays`: 1 to raysPerPatch.
VOXRAY_SEEN_FUNCTION uint packSeen(SeenLayout lists, uint target, uint rays) {
    return (target << lists.rayBits) | (rays - 1u);
}
VOXRAY_SEEN_FUNCTION uint seenTarget(SeenLayout lists, uint entry) {
    return entry >> lists.rayBits;
}
VOXRAY_SEEN_FUNCTION uint seenRays(SeenLayout lists, uint entry) {
    return (entry & ((1u << lists.rayBits) - 1u)) + 1u;
}

VOXRAY_SHARED_END

#endif
