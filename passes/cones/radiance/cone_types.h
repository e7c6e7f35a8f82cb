// A cone of a set, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_CONE_TYPES_H
#define VOXRAY_SHARED_CONE_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct Cone {
    vec2 sineSquared;  // Of the angles from the normal at which its stratum begins and ends.
    float azimuth;     // Of the stratum's center.
    float weight;      // Fraction of a uniform hemisphere's irradiance; the weights of a set add up to 1.
    float width;       // At unit distance: twice the tangent of half the cone's angle.
};

VOXRAY_SHARED_END

#endif
