// A surface in a pixel, shared by C++ and GLSL.
#ifndef VOXRAY_GATHER_SURFELS_PIXEL_SURFACE_H
#define VOXRAY_GATHER_SURFELS_PIXEL_SURFACE_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Texels of a pixel that lie close together and look the same way: one lookup serves them all.
struct PixelSurface {
    vec3 position;         // Mean, m.
    vec3 normal;           // Unit length; shading normal of the first texel.
    vec3 geometricNormal;  // Unit length, of the first texel.
    vec3 albedo;           // Sum over its texels over the number of the pixel's; 0: nothing to look up.
};

VOXRAY_SHARED_END

#endif
