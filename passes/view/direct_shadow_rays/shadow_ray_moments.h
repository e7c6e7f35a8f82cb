// Moments of shadow rays, shared by C++ and GLSL.
#ifndef VOXRAY_SHADOW_RAY_MOMENTS_H
#define VOXRAY_SHADOW_RAY_MOMENTS_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Sums over the rays of a block of texels. L: luminance of the irradiance that a ray brings, W/m².
struct ShadowRayMoments {
    float rays;          // Sum of 1
    float luminance;     // L
    float variance;      // Variance of L within a group of texels
    float change;        // Bound of L's change along the surface where the ray is unoccluded, W/m³
    float hidden;        // What an occluded ray would bring, W/m²
    float hiddenChange;  // The same over the distance in which its occluder's edge uncovers it, W/m³
};

VOXRAY_SHARED_END

#endif
