// A surface with both unoccluded and occluded surfels around it, shared by C++ and GLSL.
#ifndef VOXRAY_AMBIGUOUS_SURFACE_H
#define VOXRAY_AMBIGUOUS_SURFACE_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

#define VOXRAY_NO_SURFACE 0xffffffffu

// Radiance that a surface in a pixel reflects, W/(m² sr), by whether the surface itself is occluded.
struct AmbiguousSurface {
    vec3 unoccluded;
    vec3 occluded;
    uint next;  // The pixel's next surface, or VOXRAY_NO_SURFACE.
};

VOXRAY_SHARED_END

#endif
