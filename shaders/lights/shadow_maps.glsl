// Shadow maps of all punctual lights (host: passes/common/lights/shadow_map.h).
#ifndef VOXRAY_SHADOW_MAPS_GLSL
#define VOXRAY_SHADOW_MAPS_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "shaders/lights/light_view.glsl"

struct ShadowLight {
    uint light;  // Of the scene's.
    uint firstView;
    uint views;  // 6: a cube's sides.
};
layout(scalar) readonly buffer ShadowLights {
    uint resolution;  // Texels a side.
    uint count;
    ShadowLight data[];
} shadowLights;
layout(scalar) readonly buffer ShadowViews { LightView data[]; } shadowViews;
// By view and texel: depth relative to the view's farthest.
layout(scalar) readonly buffer ShadowDepthsRef { LargeFloats shadowDepths; };

// Whether a light sees a surface's point, by the texel that it falls into. @param normal of the side that faces the light.
bool passesShadowTest(ShadowLight l, vec3 position, vec3 normal) {
    const uint resolution = shadowLights.resolution;
    const uint at = l.firstView + (l.views == 6u ? cubeFace(position - shadowViews.data[l.firstView].origin) : 0u);
    const LightView view = shadowViews.data[at];
    const ivec2 texel = clamp(ivec2(floor(inTexels(view, resolution, position))), ivec2(0), ivec2(resolution) - 1);
    const float depth = shadowDepths.data[(at * resolution + uint(texel.y)) * resolution + uint(texel.x)];
    return texelPassesShadowTest(view, resolution, texel, depth, position, normal);
}

#endif
