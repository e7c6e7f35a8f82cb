// Surfels sorted by voxel, shared by C++ (passes/radiosity/link_surfels/) and GLSL.
#ifndef VOXRAY_SHARED_SORTED_SURFELS_H
#define VOXRAY_SHARED_SORTED_SURFELS_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Bit of a sorted surfel's id: no open space lies before it, as far as a voxel.
#define VOXRAY_OCCLUDED 0x80000000u

// What tells whether a surfel stands for a place near it.
struct SortedSurfel {
    vec3 position;  // m
    uint number;    // Through all chunks of surfels.
    vec3 normal;    // Unit length, on the lit side.
    uint id;        // As Surfel's: the same in every run, which its number is not; VOXRAY_OCCLUDED is added.
};

VOXRAY_SHARED_END

#endif
