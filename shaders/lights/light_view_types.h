// A light's view of the scene, shared by C++ (passes/common/lights/light_views.h) and GLSL
// (shaders/lights/light_view.glsl).
#ifndef VOXRAY_SHARED_LIGHT_VIEW_H
#define VOXRAY_SHARED_LIGHT_VIEW_H

#include "shaders/shared/types.h"

VOXRAY_SHARED_BEGIN

// A square view. `right`, `up` and `forward` are orthonormal.
struct LightView {
    vec3 origin;       // The light's position, m; of parallel light the center of its near plane.
    float halfExtent;  // m; of perspective views at a distance of 1 m.
    vec3 right;
    float nearest;  // Near plane, m along `forward`.
    vec3 up;
    float farthest;  // Far plane, m along `forward`.
    vec3 forward;
    uint parallel;  // 1: orthographic; 0: perspective.
};

VOXRAY_SHARED_END

#endif
