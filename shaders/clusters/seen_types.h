// What a face sees, in a word: a target, and how many of the face's rays met it. Shared by C++ and GLSL.
//
// Targets are faces: 6 * part of a cluster + face, and from 6 * parts on 6 * side + face.
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
