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
#define VOXRAY_LIGHT_TREE_FUNCTION [[gnu::always_inline]] inline
#else
#define VOXRAY_LIGHT_TREE_FUNCTION
#endif

VOXRAY_SHARED_BEGIN

#ifdef __cplusplus
using glm::abs;
using glm::dot;
using glm::max;
using glm::min;
using glm::normalize;
using std::sqrt;
#endif

// A node as what weighs it reads it, relative to its parent (of the root: to itself), as memory is what a choice waits
// for. Rounded so that it covers its lights.
struct LightTreeSummary {
    uint low;       // Of the bounds: x, y, z in 10 bits, in units of the parent's size.
    uint high;      // The same.
    uint axis;      // Of the cone that has the axes of all lights: octahedral, two times 16 bits.
    uint emission;  // LIGHT_TREE_DOUBLE_SIDED, LIGHT_TREE_COS_..., and in the low 16 bits intensity over the parent's.
};

// Children of a node are next to each other.
struct LightTreeNode {
    LightTreeSummary summary;
    uint link;    // Inner node: how many children and the first. Leaf: LIGHT_TREE_LEAF and the light.
    uint parent;  // The root's is the root.
    vec3 low;     // Bounds, m.
    vec3 size;
};

VOXRAY_SHARED_END

#define LIGHT_TREE_LEAF 0x80000000u
// Of `link` of an inner node.
#define LIGHT_TREE_COUNT_SHIFT 27u
#define LIGHT_TREE_FIRST_CHILD 0x07ffffffu
// Children that a node has at most: a node of so many lights has these.
#define LIGHT_TREE_MAX_CHILDREN 12u
// Of the numbers of lights on the device (trace/gpu_scene.h): a punctual light, otherwise an emissive triangle.
#define LIGHT_TREE_PUNCTUAL 0x40000000u
#define LIGHT_TREE_INDEX 0x3fffffffu
// Of the lights that a caller has beside the tree (pick).
#define LIGHT_TREE_BESIDE 0xffffffffu

// Of `emission`, from above: whether lights emit along their axes and against them; cosine of the largest angle from an
// axis into which a light emits, 0 to 1 in 7 bits; cosine of the half angle of the cone of axes, -1 to 1 in 8 bits.
#define LIGHT_TREE_DOUBLE_SIDED 0x80000000u
#define LIGHT_TREE_COS_EMISSION_SHIFT 24u
#define LIGHT_TREE_COS_EMISSION_STEPS 127.0f
#define LIGHT_TREE_COS_ORIENTATION_SHIFT 16u
#define LIGHT_TREE_COS_ORIENTATION_STEPS 255.0f
#define LIGHT_TREE_INTENSITY_STEPS 65535.0f
#define LIGHT_TREE_BOUNDS_STEPS 1023.0f
#define LIGHT_TREE_AXIS_STEPS 32767.0f
// Of a decoded axis: the largest error, radians.
#define LIGHT_TREE_AXIS_ERROR 1e-4f

// Where the squared distance to a node's center is less than this times the squared radius of its bounds, its children
// are weighed in its place: the lights next to a point are then not lost among others.
#define LIGHT_TREE_NEAR 2.0f
// m. Distances to a light are at least this.
#define LIGHT_TREE_MIN_DISTANCE 1e-10f
// Mean of the positive part of the cosine to an axis of any direction: what one of lights that face all directions
// emits of its intensity.
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

VOXRAY_LIGHT_TREE_FUNCTION vec3 lightTreeCorner(uint corner, vec3 low, vec3 size) {
    return low + size * (vec3(float(corner & 0x3ffu), float((corner >> 10u) & 0x3ffu), float(corner >> 20u)) *
                         (1.0f / LIGHT_TREE_BOUNDS_STEPS));
}

// Octahedral: the lower half is folded over the edges of the upper one.
VOXRAY_LIGHT_TREE_FUNCTION vec3 lightTreeAxis(uint axis) {
    const float x = float(axis & 0xffffu) / LIGHT_TREE_AXIS_STEPS - 1.0f;
    const float y = float(axis >> 16u) / LIGHT_TREE_AXIS_STEPS - 1.0f, z = 1.0f - abs(x) - abs(y);
    const float fold = max(-z, 0.0f);
    return normalize(vec3(x + (x >= 0.0f ? -fold : fold), y + (y >= 0.0f ? -fold : fold), z));
}

// A summary in meters.
struct LightTreeBounds {
    vec3 center;
    float intensity;  // Over the parent's.
    vec3 halfSize;
    float cosOrientation, sinOrientation;
    float cosEmission;
    vec3 axis;
    uint doubleSided;
};

// `low`, `size`: bounds of the parent.
VOXRAY_LIGHT_TREE_FUNCTION LightTreeBounds lightTreeBounds(LightTreeSummary node, vec3 low, vec3 size) {
    const vec3 first = lightTreeCorner(node.low, low, size), last = lightTreeCorner(node.high, low, size);
    LightTreeBounds b;
    b.center = 0.5f * (first + last);
    b.halfSize = 0.5f * (last - first);
    b.intensity = float(node.emission & 0xffffu) * (1.0f / LIGHT_TREE_INTENSITY_STEPS);
    b.cosOrientation =
        float((node.emission >> LIGHT_TREE_COS_ORIENTATION_SHIFT) & 0xffu) * (2.0f / LIGHT_TREE_COS_ORIENTATION_STEPS) -
        1.0f;
    b.sinOrientation = sqrt(max(1.0f - b.cosOrientation * b.cosOrientation, 0.0f));
    b.cosEmission =
        float((node.emission >> LIGHT_TREE_COS_EMISSION_SHIFT) & 0x7fu) * (1.0f / LIGHT_TREE_COS_EMISSION_STEPS);
    b.axis = lightTreeAxis(node.axis);
    b.doubleSided = node.emission & LIGHT_TREE_DOUBLE_SIDED;
    return b;
}

// Estimate of what a node's lights emit towards a point, over their intensity: of the cosine to their axes; where the
// node has spots alone, of one that falls from 1 along the axis to 0 at their edge. Bounds of all axes and of all
// places of lights give the range of the cosine times distance. `radius` of the bounds; `typical`: distance to the
// lights.
VOXRAY_LIGHT_TREE_FUNCTION float lightTreeEmission(LightTreeBounds b, vec3 toCenter, float distance_, float radius,
                                                   float typical) {
    if (b.cosOrientation <= -1.0f) return LIGHT_TREE_MEAN_COSINE;
    const float cosO = b.cosOrientation, sinO = b.sinOrientation;
    float along = -dot(b.axis, toCenter);
    if (b.doubleSided != 0u) along = abs(along);
    const float across = sqrt(max(distance_ * distance_ - along * along, 0.0f));
    const float most = along >= cosO * distance_ ? distance_ : cosO * along + sinO * across;
    const float least = along <= -cosO * distance_ ? -distance_ : cosO * along - sinO * across;
    const float spread = LIGHT_TREE_AXIS_ERROR * typical +
                         (cosO > 0.0f ? min(radius, cosO * dot(b.halfSize, abs(b.axis)) + sinO * radius) : radius);
    const float edge = b.cosEmission * max(distance_ - radius, 0.0f);
    float high = min(most + spread, typical) - edge;
    if (high <= 0.0f) return 0.0f;
    // Next to a lamp its nearest part emits along its axis, also where the rest is seen from the side
    const float size = min(radius / typical, 1.0f), nearness = size * size;
    high += nearness * nearness * (typical - edge - high);
    const float low = max(least - spread, -typical) - b.cosEmission * typical;
    return lightTreeMeanPositive(low, high) /
           (typical * max(1.0f - b.cosEmission, 1.0f / LIGHT_TREE_COS_EMISSION_STEPS));
}

// Estimate of the unoccluded irradiance of a node's lights at a point, over the intensity of its parent's; 0 only where
// none of them can light a surface with this unit normal. For a light that is small and no spot exact but for rounding.
VOXRAY_LIGHT_TREE_FUNCTION float lightTreeImportance(LightTreeBounds b, vec3 position, vec3 normal) {
    const vec3 toCenter = b.center - position;
    const float along = dot(toCenter, normal), spread = dot(b.halfSize, abs(normal));
    if (along + spread <= 0.0f) return 0.0f;
    const float distance2 = dot(toCenter, toCenter), radius2 = dot(b.halfSize, b.halfSize);
    const float typical = max(sqrt(distance2 + LIGHT_TREE_MEAN_DISTANCE2 * radius2), LIGHT_TREE_MIN_DISTANCE);
    const float arriving = lightTreeMeanPositive(along - spread, along + spread) / typical;
    const float emitted = lightTreeEmission(b, toCenter, sqrt(distance2), sqrt(radius2), typical);
    return b.intensity * emitted * arriving /
           max(max(distance2, LIGHT_TREE_LEAST_DISTANCE2 * radius2), LIGHT_TREE_MIN_DISTANCE * LIGHT_TREE_MIN_DISTANCE);
}

VOXRAY_LIGHT_TREE_FUNCTION bool lightTreeIsNear(LightTreeBounds b, vec3 position) {
    const vec3 toCenter = b.center - position;
    return dot(toCenter, toCenter) < LIGHT_TREE_NEAR * dot(b.halfSize, b.halfSize);
}

VOXRAY_SHARED_END

#endif
