// What a ray from a light carries, shared by C++ (passes/common/light_paths/light_paths.h) and GLSL.
#ifndef VOXRAY_SHARED_LIGHT_PATH_H
#define VOXRAY_SHARED_LIGHT_PATH_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// The ray stands for a beam whose cross-section after d metres is area + solidAngle * d². Light from surfaces, from the
// environment and after diffuse reflection has none: both are 0.
struct LightPath {
    vec3 power;        // W
    float solidAngle;  // sr; 0 for parallel light
    float area;        // m²; 0 for light from a point
    float travelled;   // m, from the light to the ray's origin
};

VOXRAY_SHARED_END

#endif
