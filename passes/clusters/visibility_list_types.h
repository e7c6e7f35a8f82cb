// Visibility lists of patches, shared by C++ and GLSL. An entry has a target and the number of rays that hit
// it. Targets are the faces of components by their index, then patches.
#ifndef VOXRAY_SHARED_VISIBILITY_LIST_TYPES_H
#define VOXRAY_SHARED_VISIBILITY_LIST_TYPES_H

#include "shaders/shared/types.h"

#ifdef __cplusplus
#define VOXRAY_LIST_FUNCTION inline
#else
#define VOXRAY_LIST_FUNCTION
#endif

VOXRAY_SHARED_BEGIN

#define NO_TARGET 0xffffffffu
#define MAX_RAYS_PER_PATCH 1024u

// Lists are stored in chunks of patches, bit-packed without padding. A list without entries takes no bits. Others begin
// with a header, targetBits - 1 (5 bits, the lowest) and rayBits (4 bits); then come the entries, sorted by target:
//
//     targetBits + rayBits - 1                 rayBits - 1           0
//     | target less that of the entry before  | number of rays - 1 |
//
// Both widths are as small as the list allows.
#define LIST_HEADER_BITS 9u

struct VisibilityListLayout {
    uint raysPerPatch;
    uint patchesPerChunk;
    uint firstPatchTarget;  // Smaller targets are component faces.
    uint rayBits;           // Of an entry before it is packed, a target and the number of rays - 1 in 32 bits.
};

// `rays`: 1 to raysPerPatch.
VOXRAY_LIST_FUNCTION uint unpackedEntry(VisibilityListLayout lists, uint target, uint rays) {
    return (target << lists.rayBits) | (rays - 1u);
}

VOXRAY_LIST_FUNCTION uint listHeader(uint targetBits, uint rayBits) {
    return (targetBits - 1u) | (rayBits << 5u);
}
VOXRAY_LIST_FUNCTION uint targetBitsOf(uint header) {
    return (header & 31u) + 1u;
}
VOXRAY_LIST_FUNCTION uint rayBitsOf(uint header) {
    return header >> 5u;
}

VOXRAY_SHARED_END

#endif
