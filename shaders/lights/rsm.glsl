// Reflective shadow maps of all lights (host: passes/common/lights/rsm.h).
#ifndef VOXRAY_RSM_GLSL
#define VOXRAY_RSM_GLSL


#include "shaders/lights/light_view.glsl"
#include "shaders/lights/rsm_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RsmTexels { RsmTexel data[]; };
layout(scalar) readonly buffer RsmTexelsRef { RsmTexels rsmTexels; };
// By light, then by view.
layout(scalar) readonly buffer RsmViews { RsmView data[]; } rsmViews;

// What a texel of a view sees. `view` is its number among all lights' views.
RsmTexel rsmTexel(uint view, uint resolution, ivec2 at) {
    return rsmTexels.data[(view * resolution + uint(at.y)) * resolution + uint(at.x)];
}

#endif
