// Reflective shadow maps of all lights (host: passes/common/lights/rsm.h).
#ifndef VOXRAY_RSM_GLSL
#define VOXRAY_RSM_GLSL

#include "shaders/lights/light_view.glsl"
#include "shaders/lights/rsm_types.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RsmTexels { RsmTexel data[]; };
layout(scalar) readonly buffer RsmTexelsRef { RsmTexels rsmTexels; };
layout(scalar) readonly buffer RsmViews { RsmView data[]; } rsmViews;  // By light, then by view.

// `view`: index among the views of all lights.
RsmTexel rsmTexel(uint view, uint resolution, ivec2 texel) {
    return rsmTexels.data[(view * resolution + uint(texel.y)) * resolution + uint(texel.x)];
}

#endif
