// Surfels sorted by voxel, shared by C++ (passes/surfels/surfel_sort.h) and GLSL.
#ifndef VOXRAY_SHARED_SORTED_SURFELS_H
#define VOXRAY_SHARED_SORTED_SURFELS_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Bit of a sorted surfel's id: it is occluded.
#define VOXRAY_OCCLUDED 0x80000000u

struct SortedSurfel {
    vec3 position;  // m
    uint index;     // Among the surfels of all chunks; may differ from run to run.
    vec3 normal;    // Unit length, on the surfel's side.
    uint id;        // Surfel::id, the same in every run, and VOXRAY_OCCLUDED.
};

VOXRAY_SHARED_END

#endif
