// Statistics of gather rays for the irradiance filter, shared by C++ and GLSL.
#ifndef VOXRAY_SHARED_RAY_MOMENTS_H
#define VOXRAY_SHARED_RAY_MOMENTS_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Sums over the rays of a block of texels. L: π times the luminance of a ray's radiance, W/m²; r: distance of
// its hit, m (1/r is 0 for a miss).
struct RayMoments {
    float rays;                   // Sum of 1
    float luminance;              // L
    float squared;                // L²
    float inverseDistance;        // 1/r
    float luminanceOverDistance;  // L/r
    float squaredOverDistance;    // L²/r
};

VOXRAY_SHARED_END

#endif
