// What a patch sees, in a word: a target, and how many of the patch's rays met it. Shared by C++ and GLSL.
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
#define SEEN_RAY_BITS 10u
#define SEEN_MAX_RAYS 1024u
#define SEEN_MAX_TARGETS 4194304u

// How lists are laid out. Those of patches are held in chunks.
struct SeenLayout {
    uint raysPerPatch;
    uint patchesPerChunk;
    uint sideTargets;  // Targets from here on are patches, before it faces of parts.
};

// `rays`: 1 to 1024.
VOXRAY_SEEN_FUNCTION uint packSeen(uint target, uint rays) {
    return (target << SEEN_RAY_BITS) | (rays - 1u);
}
VOXRAY_SEEN_FUNCTION uint seenTarget(uint seen) {
    return seen >> SEEN_RAY_BITS;
}
VOXRAY_SEEN_FUNCTION uint seenRays(uint seen) {
    return (seen & (SEEN_MAX_RAYS - 1u)) + 1u;
}

VOXRAY_SHARED_END

#endif
