// A surface that surfels of both kinds are near, shared by C++ and GLSL.
#ifndef VOXRAY_GATHER_SURFELS_UNDECIDED_H
#define VOXRAY_GATHER_SURFELS_UNDECIDED_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

#define VOXRAY_NO_UNDECIDED 0xffffffffu

// What a surface in a pixel reflects, W/(m² sr): the light of open surfels where open space lies before it,
// else that of covered ones.
struct Undecided {
    vec3 open;
    vec3 covered;
    uint next;  // Of the same pixel, or VOXRAY_NO_UNDECIDED.
};

VOXRAY_SHARED_END

#endif
