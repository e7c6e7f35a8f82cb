// Texels of a light's view.
#ifndef VOXRAY_LIGHT_VIEW_GLSL
#define VOXRAY_LIGHT_VIEW_GLSL


#include "shaders/lights/light_view_types.h"

// What a texel's center looks along: points start + depth * along, at `depth` metres along view.forward.
struct TexelRay {
    vec3 start;
    vec3 along;
};

// Width of a texel: m for parallel light, else at a distance of 1 m.
float texelWidth(LightView view, uint resolution) {
    return 2.0 * view.halfExtent / float(resolution);
}

// A texel's center on the view, in units of its halfExtent's.
vec2 texelOnView(LightView view, uint resolution, ivec2 texel) {
    return (vec2(texel) + 0.5) * texelWidth(view, resolution) - view.halfExtent;
}

TexelRay texelRay(LightView view, vec2 onView) {
    const vec3 across = onView.x * view.right + onView.y * view.up;
    if (view.parallel != 0u) return TexelRay(view.origin + across, view.forward);
    return TexelRay(view.origin, view.forward + across);
}

// Where a position lies on the view, in texels from its corner on.
vec2 inTexels(LightView view, uint resolution, vec3 position) {
    const vec3 away = position - view.origin;
    vec2 onView = vec2(dot(away, view.right), dot(away, view.up));
    if (view.parallel == 0u) onView /= dot(away, view.forward);
    return (onView + view.halfExtent) / texelWidth(view, resolution);
}

// Of the four texels whose centers are nearest to a position on the view the first, and their bilinear weights, row by row. Within
// half a texel of the border there is none further out.
ivec2 nearestTexels(LightView view, uint resolution, vec3 position, out vec4 weights) {
    const vec2 at = inTexels(view, resolution, position) - 0.5;
    const ivec2 first = clamp(ivec2(floor(at)), ivec2(0), ivec2(resolution) - 2);
    const vec2 along = clamp(at - vec2(first), 0.0, 1.0);
    weights = vec4(1.0 - along.x, along.x, 1.0 - along.x, along.x) * vec4(vec2(1.0 - along.y), vec2(along.y));
    return first;
}

// The side of a cube of views that sees a direction, in the order +x -x +y -y +z -z.
uint cubeFace(vec3 v) {
    const vec3 a = abs(v);
    const uint axis = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
    return 2u * axis + (v[axis] < 0.0 ? 1u : 0u);
}

// Whether a texel of a shadow map sees a surface's point: if nothing lies before the point's tangent plane on the texel's own ray.
// So flat surfaces do not shade themselves at any slope. Half a texel's width is to spare for what is curved, and for rounding.
// @param depth what the map holds there. @param normal of the side that faces the light.
bool texelPassesShadowTest(LightView view, uint resolution, ivec2 texel, float depth, vec3 position, vec3 normal) {
    const TexelRay ray = texelRay(view, texelOnView(view, resolution, texel));
    const float towards = dot(ray.along, normal);
    const float plane = towards < 0.0 ? min(dot(position - ray.start, normal) / towards, view.farthest) : view.farthest;
    const float nearest = depth * view.farthest;
    const float width = texelWidth(view, resolution) * (view.parallel != 0u ? 1.0 : nearest);
    return nearest + 0.5 * width >= plane;
}

#endif
