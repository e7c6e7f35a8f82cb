// A gather ray's hit that is kept from frame to frame, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_KEPT_HIT_TYPES_H
#define VOXRAY_SHARED_KEPT_HIT_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct KeptHit {
    uint face;         // Number of the face whose light it reads; NO_FACE: none.
    uint reflectance;  // Of the hit, packUnorm4x8.
    vec3 rest;         // What its ray brought beyond the light of that face then, W/m².
};

VOXRAY_SHARED_END

#endif
