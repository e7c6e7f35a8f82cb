// What a shadow ray brings, shared by C++ and GLSL.
#ifndef VOXRAY_SHADOW_RAY_LIGHT_H
#define VOXRAY_SHADOW_RAY_LIGHT_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

struct ShadowRayLight {
    vec3 irradiance;      // If it is unoccluded, W/m².
    float width;          // Of the solid angle that the ray stands for, over that of a ray distributed by cosine.
    float inverseHeight;  // One over the distance from the plane of an emissive surface, 1/m; 0 for other sources.
};

VOXRAY_SHARED_END

#endif
