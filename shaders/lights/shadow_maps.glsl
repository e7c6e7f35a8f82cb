// Shadow maps of all punctual lights (host: passes/common/lights/shadow_map.h).
#ifndef VOXRAY_SHADOW_MAPS_GLSL
#define VOXRAY_SHADOW_MAPS_GLSL

#include "shaders/compute/large_buffer.glsl"
#include "shaders/lights/light_view.glsl"

struct ShadowLight {
    uint light;  // Index in the scene.
    uint firstView;
    uint views;  // 6: the faces of a cube map.
};
layout(scalar) readonly buffer ShadowLights {
    uint resolution;  // Texels along an edge of a view.
    uint count;
    ShadowLight data[];
} shadowLights;
layout(scalar) readonly buffer ShadowViews { LightView data[]; } shadowViews;
// By view and texel: depth over LightView::farthest.
layout(scalar) readonly buffer ShadowDepthsRef { LargeFloats shadowDepths; };

// Shadow test of a surface point, by the texel that it projects to. @param normal on the side that faces the light.
bool passesShadowTest(ShadowLight l, vec3 position, vec3 normal) {
    const uint resolution = shadowLights.resolution;
    const uint index = l.firstView + (l.views == 6u ? cubeFace(position - shadowViews.data[l.firstView].origin) : 0u);
    const LightView view = shadowViews.data[index];
    const ivec2 texel =
        clamp(ivec2(floor(texelCoordinates(view, resolution, position))), ivec2(0), ivec2(resolution) - 1);
    const float depth = shadowDepths.data[(index * resolution + uint(texel.y)) * resolution + uint(texel.x)];
    return texelPassesShadowTest(view, resolution, texel, depth, position, normal);
}

#endif
