// Texels of a light's view.
#ifndef VOXRAY_LIGHT_VIEW_GLSL
#define VOXRAY_LIGHT_VIEW_GLSL

#extension GL_EXT_scalar_block_layout : require

#include "shaders/shared/light_view.h"

// What a texel's middle looks along: points start + depth * along, at `depth` metres along view.forward.
struct TexelRay {
    vec3 start;
    vec3 along;
};

// Width of a texel: m for parallel light, else at a distance of 1 m.
float texelWidth(LightView view, uint resolution) {
    return 2.0 * view.halfExtent / float(resolution);
}

// A texel's middle on the view, in units of its halfExtent's.
vec2 texelOnView(LightView view, uint resolution, ivec2 texel) {
    return (vec2(texel) + 0.5) * texelWidth(view, resolution) - view.halfExtent;
}

TexelRay texelRay(LightView view, vec2 onView) {
    const vec3 across = onView.x * view.right + onView.y * view.up;
    if (view.parallel != 0u) return TexelRay(view.origin + across, view.forward);
    return TexelRay(view.origin, view.forward + across);
}

#endif
