// The side that a surfel is on, by its id, shared by C++ (kept_sides.cpp) and GLSL.
#ifndef VOXRAY_SAVED_SIDE_H
#define VOXRAY_SAVED_SIDE_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct SavedSide {
    uint side;     // Among those of its voxel, in the order in which they were found.
    float height;  // As PatchSurfel's.
};

VOXRAY_SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SavedSides {
    SavedSide data[];
};
#endif

#endif
