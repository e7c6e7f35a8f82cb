// A light's view of the scene, shared by C++ (passes/common/lights/light_views.h) and GLSL
// (shaders/lights/light_view.glsl).
#ifndef VOXRAY_SHARED_LIGHT_VIEW_H
#define VOXRAY_SHARED_LIGHT_VIEW_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// Square. `right`, `up` and `forward` are of unit length and at right angles.
struct LightView {
    vec3 origin;       // The light, or the center of the disc that parallel light starts from.
    float halfExtent;  // Of the view: m for parallel light, else at a distance of 1 m.
    vec3 right;
    float nearest;  // m, along `forward`, as `farthest`.
    vec3 up;
    float farthest;
    vec3 forward;
    uint parallel;
};

VOXRAY_SHARED_END

#endif
