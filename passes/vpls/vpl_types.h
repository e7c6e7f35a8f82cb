// Virtual point lights, shared by C++ (passes/vpls/) and GLSL.
#ifndef VOXRAY_SHARED_VPL_TYPES_H
#define VOXRAY_SHARED_VPL_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A surface point that emits the light that the surface reflects there: radiant intensity flux * cos / pi,
// W/sr.
struct Vpl {
    vec3 position;  // m; off the surface, where rays may begin (SurfacePoint::offset).
    vec3 normal;    // Unit normal of the triangle, or of the voxel, on the lit side.
    vec3 flux;      // Reflected, W.
};

VOXRAY_SHARED_END

#endif
