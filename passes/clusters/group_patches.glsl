// Access to the patches of a surface group and to the faces of a component (surface_group_types.h). Only those that
// exist have an index.
#ifndef VOXRAY_GROUP_PATCHES_GLSL
#define VOXRAY_GROUP_PATCHES_GLSL

#include "passes/clusters/surface_group_types.h"

bool isOccluded(SurfaceGroup group) { return (group.flags & GROUP_OCCLUDED) != 0u; }

bool hasPatch(SurfaceGroup group, uint face) { return (group.flags >> face & 1u) != 0u; }

bool hasFace(ClusterComponent component, uint face) { return (component.faces >> face & 1u) != 0u; }

uint bitsBelow(uint bits, uint bit) { return uint(bitCount(bits & ((1u << bit) - 1u))); }

// Index of the patch at a face for which hasPatch() is true.
uint patchIndex(SurfaceGroup group, uint face) { return group.firstPatch + bitsBelow(group.flags, face); }

// Index of a component's face at which one of its groups has a patch.
uint componentFaceIndex(ClusterComponent component, uint face) {
    return component.firstFace + bitsBelow(component.faces, face);
}

#endif
