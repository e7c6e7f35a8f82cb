// Views of a light for shadow maps: from texels to rays, from positions to texels, and the shadow test.
#ifndef VOXRAY_LIGHT_VIEW_GLSL
#define VOXRAY_LIGHT_VIEW_GLSL

#include "shaders/lights/light_view_types.h"

// The ray through a texel's center: origin + depth * direction is `depth` metres along view.forward.
struct TexelRay {
    vec3 origin;
    vec3 direction;  // Not normalized.
};

// Width of a texel, m; of perspective views at a distance of 1 m.
float texelWidth(LightView view, uint resolution) {
    return 2.0 * view.halfExtent / float(resolution);
}

// Center of a texel on the view's plane, in units of view.halfExtent.
vec2 texelCenter(LightView view, uint resolution, ivec2 texel) {
    return (vec2(texel) + 0.5) * texelWidth(view, resolution) - view.halfExtent;
}

TexelRay texelRay(LightView view, vec2 planePoint) {
    const vec3 offset = planePoint.x * view.right + planePoint.y * view.up;
    if (view.parallel != 0u) return TexelRay(view.origin + offset, view.forward);
    return TexelRay(view.origin, view.forward + offset);
}

// Projects a position to texel coordinates.
vec2 texelCoordinates(LightView view, uint resolution, vec3 position) {
    const vec3 offset = position - view.origin;
    vec2 planePoint = vec2(dot(offset, view.right), dot(offset, view.up));
    if (view.parallel == 0u) planePoint /= dot(offset, view.forward);
    return (planePoint + view.halfExtent) / texelWidth(view, resolution);
}

// First of the 2x2 texels for bilinear interpolation at a position, and their weights, row by row. Clamped at the
// view's border.
ivec2 bilinearTexels(LightView view, uint resolution, vec3 position, out vec4 weights) {
    const vec2 coordinates = texelCoordinates(view, resolution, position) - 0.5;
    const ivec2 first = clamp(ivec2(floor(coordinates)), ivec2(0), ivec2(resolution) - 2);
    const vec2 f = clamp(coordinates - vec2(first), 0.0, 1.0);
    weights = vec4(1.0 - f.x, f.x, 1.0 - f.x, f.x) * vec4(vec2(1.0 - f.y), vec2(f.y));
    return first;
}

// The face of a cube map that a direction points to, in the order +x -x +y -y +z -z.
uint cubeFace(vec3 v) {
    const vec3 a = abs(v);
    const uint axis = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
    return 2u * axis + (v[axis] < 0.0 ? 1u : 0u);
}

// Shadow test of a surface point against a texel: the texel's depth is compared with where its ray intersects the
// point's tangent plane. So flat surfaces don't shadow themselves at any slope. The bias of half a texel's width is for
// curved surfaces and rounding.
// @param depth of the texel, as stored. @param normal on the side that faces the light.
bool texelPassesShadowTest(LightView view, uint resolution, ivec2 texel, float depth, vec3 position, vec3 normal) {
    const TexelRay ray = texelRay(view, texelCenter(view, resolution, texel));
    // Change of the height over the tangent plane per meter of depth
    const float slope = dot(ray.direction, normal);
    const float planeDepth =
        slope < 0.0 ? min(dot(position - ray.origin, normal) / slope, view.farthest) : view.farthest;
    const float texelDepth = depth * view.farthest;
    const float width = texelWidth(view, resolution) * (view.parallel != 0u ? 1.0 : texelDepth);
    return texelDepth + 0.5 * width >= planeDepth;
}

#endif
