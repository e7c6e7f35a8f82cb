// The patches of a side by its faces (patch_types.h).
#ifndef VOXRAY_SIDE_PATCHES_GLSL
#define VOXRAY_SIDE_PATCHES_GLSL

#include "passes/clusters/patch_types.h"

bool hasPatch(SurfaceSide side, uint face) { return (side.faces >> face & 1u) != 0u; }

// The number of its patch at a face that it has.
uint patchAt(SurfaceSide side, uint face) { return side.firstPatch + uint(bitCount(side.faces & ((1u << face) - 1u))); }

#endif
