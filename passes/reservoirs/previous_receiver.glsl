// Receivers of the previous frame, in the scene as it is now.
#ifndef VOXRAY_RESERVOIR_PREVIOUS_RECEIVER_GLSL
#define VOXRAY_RESERVOIR_PREVIOUS_RECEIVER_GLSL

#include "passes/reservoirs/reservoir_types.h"

// How far the surface point of a texel has moved since the previous frame, m; exactly 0 where it stands still.
vec3 surfaceShift(sampler2D position, sampler2D previous, ivec2 texel) {
    return texelFetch(position, texel, 0).xyz - texelFetch(previous, texel, 0).xyz;
}

// Moved along with a surface point next to it. Its normals stay: what turns in one frame is left out.
Receiver previousReceiver(Receiver before, vec3 shift) {
    before.origin += shift;
    return before;
}

#endif
