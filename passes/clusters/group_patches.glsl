// Access to the patches of a surface group by face (surface_group_types.h).
#ifndef VOXRAY_GROUP_PATCHES_GLSL
#define VOXRAY_GROUP_PATCHES_GLSL

#include "passes/clusters/surface_group_types.h"

bool hasPatch(SurfaceGroup group, uint face) { return (group.faces >> face & 1u) != 0u; }

// Index of the patch at a face for which hasPatch() is true.
uint patchIndex(SurfaceGroup group, uint face) {
    return group.firstPatch + uint(bitCount(group.faces & ((1u << face) - 1u)));
}

#endif
