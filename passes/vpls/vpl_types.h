// Virtual point lights, shared by C++ (passes/vpls/) and GLSL.
#ifndef VOXRAY_SHARED_VPL_TYPES_H
#define VOXRAY_SHARED_VPL_TYPES_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A point on one side of a Lambert surface that sends light on: cosine / pi times its flux, W/sr.
struct Vpl {
    vec3 position;    // m; so far off its surface that rays may begin there (SurfacePoint::offset).
    vec3 normal;      // Unit length: the shading normal, which the cosine is about.
    vec3 faceNormal;  // Unit length: the triangle's, on the same side. Nothing is sent below it.
    vec3 flux;        // W, that the surface reflects here.
};

VOXRAY_SHARED_END

#endif
