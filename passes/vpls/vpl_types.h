// Virtual point lights, shared by C++ (passes/vpls/) and GLSL.
#ifndef VOXRAY_SHARED_VPL_TYPES_H
#define VOXRAY_SHARED_VPL_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A surface point that stands for the light that the surface reflects there: radiant intensity flux * cos /
// pi, W/sr.
struct Vpl {
    vec3 position;    // m, offset off the surface: rays may begin here (SurfacePoint::offset).
    vec3 normal;      // Unit shading normal, from which the cosine is measured.
    vec3 faceNormal;  // Unit normal of the triangle, on the same side. No light is sent below it.
    vec3 flux;        // Reflected, W.
};

VOXRAY_SHARED_END

#endif
