// A cone of a set, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_CONE_TYPES_H
#define VOXRAY_SHARED_CONE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct Cone {
    vec2 sineSquared;  // Of the angles from the normal between which its stratum lies.
    float azimuth;     // Of the stratum's center.
    float weight;  // Part of the irradiance of an even hemisphere that comes through it; a set's add up to 1.
    float width;   // Of the cone at unit distance: twice the tangent of half its angle.
};

VOXRAY_SHARED_END

#endif
