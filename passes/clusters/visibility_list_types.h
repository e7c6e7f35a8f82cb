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

// Lists are stored in chunks of patches. The entries of a chunk are bit-packed without padding: bits 0 to
// entryBits - 1 of its words are the first entry.
//
//     entryBits - 1       rayBits - 1           0
//     | target            | number of rays - 1 |
struct VisibilityListLayout {
    uint raysPerPatch;
    uint patchesPerChunk;
    uint firstPatchTarget;  // Smaller targets are component faces.
    uint rayBits;
    uint entryBits;  // 1 to 32.
};

// `rays`: 1 to raysPerPatch.
VOXRAY_LIST_FUNCTION uint packEntry(VisibilityListLayout lists, uint target, uint rays) {
    return (target << lists.rayBits) | (rays - 1u);
}
VOXRAY_LIST_FUNCTION uint entryTarget(VisibilityListLayout lists, uint entry) {
    return entry >> lists.rayBits;
}
VOXRAY_LIST_FUNCTION uint entryRays(VisibilityListLayout lists, uint entry) {
    return (entry & ((1u << lists.rayBits) - 1u)) + 1u;
}

VOXRAY_SHARED_END

#endif
