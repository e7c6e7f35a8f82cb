// Reflective shadow maps, shared by C++ (passes/common/lights/rsm.h) and GLSL (shaders/lights/rsm.glsl).
#ifndef VOXRAY_SHARED_RSM_TYPES_H
#define VOXRAY_SHARED_RSM_TYPES_H

#include "shaders/lights/light_view_types.h"

VOXRAY_SHARED_BEGIN

// A view of a punctual light of the scene.
struct RsmView {
    LightView view;
    uint light;
    uint cubeFace;  // In the order +x -x +y -y +z -z; 6: the view is not one of a cube's.
};

// The point that a texel sees.
struct RsmTexel {
    uint triangle;  // NO_HIT: none.
    vec2 barycentrics;
    uint unused;
};

VOXRAY_SHARED_END

#endif
