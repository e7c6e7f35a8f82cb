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
using glm::abs;
using glm::dot;
using glm::max;
using glm::min;
using std::sqrt;
#endif

// Children of a node are next to each other.
struct LightTreeNode {
    vec3 center;      // Of the bounds, m.
    float intensity;  // Sum over its lights, over that of all lights (scene/light_tree.h).
    vec3 halfSize;    // Of the bounds, m.
    uint emission;    // LIGHT_TREE_COS_... and LIGHT_TREE_DOUBLE_SIDED.
    vec3 axis;        // Of the cone that has the axes of all its lights; unit length.
    uint link;        // Inner node: how many children and the first. Leaf: LIGHT_TREE_LEAF and the light.
    uint parent;
};

VOXRAY_SHARED_END

#define LIGHT_TREE_LEAF 0x80000000u
// Of `link` of an inner node.
#define LIGHT_TREE_COUNT_SHIFT 27u
#define LIGHT_TREE_FIRST_CHILD 0x07ffffffu
// Children that a node has at most: a node of so many lights has these, one of more lights LIGHT_TREE_ARITY nodes.
#define LIGHT_TREE_MAX_CHILDREN 12u
#define LIGHT_TREE_ARITY 4u
// Of the numbers of lights on the device (trace/gpu_scene.h): a punctual light, otherwise an emissive triangle.
#define LIGHT_TREE_PUNCTUAL 0x40000000u
#define LIGHT_TREE_INDEX 0x3fffffffu
// Of the lights that a caller has beside the tree (pick).
#define LIGHT_TREE_BESIDE 0xffffffffu

// Of `emission`: cosine of the half angle of the cone of axes, -1 to 1 in 16 bits, rounded down; cosine of the largest
// angle from an axis into which a light emits, 0 to 1 in 15 bits, rounded down; whether lights emit along their axes
// and against them.
#define LIGHT_TREE_COS_ORIENTATION_STEPS 65535.0f
#define LIGHT_TREE_COS_EMISSION_SHIFT 16u
#define LIGHT_TREE_COS_EMISSION_STEPS 32767.0f
#define LIGHT_TREE_DOUBLE_SIDED 0x80000000u

// m. Distances to a light are at least this.
#define LIGHT_TREE_MIN_DISTANCE 1e-10f
// Mean of the positive part of the cosine to an axis of any direction: what one of lights that face all directions emits
// of its intensity.
#define LIGHT_TREE_MEAN_COSINE 0.25f
// Squared distance of points in a box to its center over that of its corners: one third is the mean. The mean of one
// over it is larger.
#define LIGHT_TREE_MEAN_DISTANCE2 (1.0f / 3.0f)
#define LIGHT_TREE_LEAST_DISTANCE2 0.25f

VOXRAY_SHARED_BEGIN

// Mean of the positive part of what is spread evenly from `low` to `high`.
VOXRAY_LIGHT_TREE_FUNCTION float lightTreeMeanPositive(float low, float high) {
    if (high <= 0.0f) return 0.0f;
    return low >= 0.0f ? 0.5f * (low + high) : 0.5f * high * high / (high - low);
}

// Estimate of what a node's lights emit towards a point, over their intensity: of the cosine to their axes; where the
// node has spots alone, of one that falls from 1 along the axis to 0 at their edge. Bounds of all axes and of all places
// of lights give the range of the cosine times distance. `radius` of the bounds; `typical`: distance to the lights.
VOXRAY_LIGHT_TREE_FUNCTION float lightTreeEmission(LightTreeNode node, vec3 toCenter, float distance_, float radius,
                                                   float typical) {
    const float cosO = float(node.emission & 0xffffu) * (2.0f / LIGHT_TREE_COS_ORIENTATION_STEPS) - 1.0f;
    if (cosO <= -1.0f) return LIGHT_TREE_MEAN_COSINE;
    const float cosEmission =
        float((node.emission >> LIGHT_TREE_COS_EMISSION_SHIFT) & 0x7fffu) * (1.0f / LIGHT_TREE_COS_EMISSION_STEPS);
    const float sinO = sqrt(max(1.0f - cosO * cosO, 0.0f));
    float along = -dot(node.axis, toCenter);
    if ((node.emission & LIGHT_TREE_DOUBLE_SIDED) != 0u) along = abs(along);
    const float across = sqrt(max(distance_ * distance_ - along * along, 0.0f));
    const float most = along >= cosO * distance_ ? distance_ : cosO * along + sinO * across;
    const float least = along <= -cosO * distance_ ? -distance_ : cosO * along - sinO * across;
    const float spread = cosO > 0.0f ? min(radius, cosO * dot(node.halfSize, abs(node.axis)) + sinO * radius) : radius;
    const float high = min(most + spread, typical) - cosEmission * max(distance_ - radius, 0.0f);
    const float low = max(least - spread, -typical) - cosEmission * typical;
    return lightTreeMeanPositive(low, high) /
           (typical * max(1.0f - cosEmission, 1.0f / LIGHT_TREE_COS_EMISSION_STEPS));
}

// Estimate of the unoccluded irradiance of a node's lights at a point, over the intensity of all lights; 0 only where
// none of them can light a surface with this unit normal. For a light that is small and no spot exact.
VOXRAY_LIGHT_TREE_FUNCTION float lightTreeImportance(LightTreeNode node, vec3 position, vec3 normal) {
    const vec3 toCenter = node.center - position;
    const float distance2 = dot(toCenter, toCenter), radius2 = dot(node.halfSize, node.halfSize);
    const float typical = max(sqrt(distance2 + LIGHT_TREE_MEAN_DISTANCE2 * radius2), LIGHT_TREE_MIN_DISTANCE);
    const float along = dot(toCenter, normal), spread = dot(node.halfSize, abs(normal));
    const float arriving = lightTreeMeanPositive(along - spread, along + spread) / typical;
    const float emitted = lightTreeEmission(node, toCenter, sqrt(distance2), sqrt(radius2), typical);
    return node.intensity * emitted * arriving /
           max(max(distance2, LIGHT_TREE_LEAST_DISTANCE2 * radius2), LIGHT_TREE_MIN_DISTANCE * LIGHT_TREE_MIN_DISTANCE);
}

VOXRAY_SHARED_END

#endif
