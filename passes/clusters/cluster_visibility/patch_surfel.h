// A surfel at which visibility rays begin or end, shared by C++ (cluster_visibility.cpp) and GLSL.
#ifndef VOXRAY_PATCH_SURFEL_H
#define VOXRAY_PATCH_SURFEL_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct PatchSurfel {
    vec3 position;  // m; off the surface, where rays may begin.
    uint id;        // That of Surfel.
    vec3 normal;    // Unit length, on the lit side.
    float height;   // m, of the points in front of it at which rays to it end: half a voxel, or half the clearance
                    // (measure_clearance.comp).
};

VOXRAY_SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchSurfels {
    PatchSurfel data[];
};
layout(scalar) readonly buffer PatchSurfelsRef {
    PatchSurfels patchSurfels;  // In the order of VoxelPatches::surfelIds.
};

// The point in front of a surfel at which visibility rays from hits end, m.
vec3 pointAbove(PatchSurfel s) {
    return s.position + s.height * s.normal;
}
#endif

#endif
