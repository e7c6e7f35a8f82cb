// A surfel while surfels are grouped, shared by C++ (find_patches.cpp) and GLSL.
#ifndef VOXRAY_GROUPED_SURFEL_H
#define VOXRAY_GROUPED_SURFEL_H

#include "passes/clusters/surface_group_types.h"

VOXRAY_SHARED_BEGIN

struct GroupedSurfel {
    vec3 position;  // m, as Surfel's.
    uint id;        // That of Surfel: the same in every run.
    vec3 normal;    // Unit length, on the lit side.
    uint voxel;
    vec3 reflectance;
    uint group;       // Index within its voxel, in the order in which groups are found.
    float height;     // m, of the origin of visibility rays above the surface: half a voxel, or half the gap.
    uint isOccluded;  // 1: another surface lies in front of it, closer than a voxel's width.
};

VOXRAY_SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer GroupedSurfels {
    GroupedSurfel data[];
};
layout(scalar) readonly buffer GroupedSurfelsRef {
    GroupedSurfels groupedSurfels;  // Sorted by voxel.
};

// The point in front of a surfel at which visibility rays to other surfels begin and end, m.
vec3 pointAbove(GroupedSurfel s) {
    return s.position + s.height * s.normal;
}
#endif

#endif
