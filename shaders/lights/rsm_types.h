// Reflective shadow maps, shared by C++ (passes/common/lights/rsm.h) and GLSL (shaders/lights/rsm.glsl).
#ifndef VOXRAY_SHARED_RSM_TYPES_H
#define VOXRAY_SHARED_RSM_TYPES_H

#include "shaders/lights/light_view_types.h"

VOXRAY_SHARED_BEGIN

// A view of a punctual light.
struct RsmView {
    LightView view;
    uint light;     // Index in the scene.
    uint cubeFace;  // In the order +x -x +y -y +z -z; 6: the view is not one of a cube's.
};

// The visible point of a texel.
struct RsmTexel {
    uint triangle;  // NO_HIT: no surface.
    vec2 barycentrics;
    uint unused;
};

VOXRAY_SHARED_END

#endif
