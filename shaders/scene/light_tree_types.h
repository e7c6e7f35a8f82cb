// A tree over point and spot lights and emissive triangles, from which one is picked by its estimated irradiance at a
// point. Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting". Shared by C++
// (scene/light_tree.h) and GLSL (shaders/scene/light_tree.glsl).
#ifndef VOXRAY_SHARED_LIGHT_TREE_TYPES_H
#define VOXRAY_SHARED_LIGHT_TREE_TYPES_H

#include "shaders/shared/types.h"

#ifdef __cplusplus
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#define VOXRAY_LIGHT_TREE_FUNCTION inline
#else
#define VOXRAY_LIGHT_TREE_FUNCTION
#endif

VOXRAY_SHARED_BEGIN

#ifdef __cplusplus
using glm::dot;
using glm::max;
using std::abs;
using std::sqrt;
#endif

// The first child of an inner node is the next node.
struct LightTreeNode {
    vec3 low;         // Bounds, m.
    float intensity;  // Sum of the largest radiant intensities of its lights, over that of all lights.
    vec3 high;
    float cosOrientation;  // Half angle of the cone round `axis` that has the axes of all its lights.
    vec3 axis;             // Unit length.
    float cosEmission;     // Largest angle from a light's axis into which it emits; 0 to 90 degrees.
    uint link;             // Inner node: its second child. Leaf: LIGHT_TREE_LEAF and the light.
    uint parent;
    uint doubleSided;  // 1: lights emit along their axes and against them.
};

VOXRAY_SHARED_END

#define LIGHT_TREE_LEAF 0x80000000u
// Of the numbers of lights on the device (trace/gpu_scene.h): a punctual light, otherwise an emissive triangle.
#define LIGHT_TREE_PUNCTUAL 0x40000000u
#define LIGHT_TREE_INDEX 0x3fffffffu
// m². Squared distances to a light are at least this.
#define LIGHT_TREE_MIN_DISTANCE2 1e-20f

VOXRAY_SHARED_BEGIN

// Sine and cosine of max(0, a - b), for angles from 0 to 180 degrees.
VOXRAY_LIGHT_TREE_FUNCTION vec2 lightTreeAngleBeyond(vec2 a, vec2 b) {
    return a.y >= b.y ? vec2(0.0f, 1.0f) : vec2(a.x * b.y - a.y * b.x, a.y * b.y + a.x * b.x);
}

// Sine and cosine of an angle from 0 to 180 degrees.
VOXRAY_LIGHT_TREE_FUNCTION vec2 lightTreeAngle(float cosine) {
    return vec2(sqrt(max(1.0f - cosine * cosine, 0.0f)), cosine);
}

// Estimate of the unoccluded irradiance of a node's lights at a point, over the intensity of all lights; 0 only where
// none of them can light a surface with this unit normal. For a light that is small and unlike a spot exact. All lights
// are taken to be in the center of the bounds, and turned towards the point as far as the bounds and the cone allow
// (section 4.2). A squared distance is no less than that of lights spread evenly over the bounds to their center.
VOXRAY_LIGHT_TREE_FUNCTION float lightTreeImportance(LightTreeNode node, vec3 position, vec3 normal) {
    const vec3 center = 0.5f * (node.low + node.high), toCenter = center - position, corner = node.high - center;
    const float distance2 = dot(toCenter, toCenter), radius2 = dot(corner, corner);
    const vec3 direction = distance2 > 0.0f ? toCenter / sqrt(distance2) : normal;
    // Half angle of the cone that the bounds' sphere subtends
    const vec2 extent = distance2 > radius2 ? lightTreeAngle(sqrt(1.0f - radius2 / distance2)) : vec2(0.0f, -1.0f);
    const float alongAxis = -dot(node.axis, direction);
    const vec2 fromAxis = lightTreeAngle(node.doubleSided != 0u ? abs(alongAxis) : alongAxis);
    const vec2 emitted =
        lightTreeAngleBeyond(lightTreeAngleBeyond(fromAxis, lightTreeAngle(node.cosOrientation)), extent);
    if (emitted.y <= node.cosEmission) return 0.0f;
    const vec2 arriving = lightTreeAngleBeyond(lightTreeAngle(dot(direction, normal)), extent);
    return node.intensity * emitted.y * max(arriving.y, 0.0f) /
           max(max(distance2, radius2 / 3.0f), LIGHT_TREE_MIN_DISTANCE2);
}

VOXRAY_SHARED_END

#endif
