#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "scene/geometry.h"

namespace voxray {

/// Where a light is and where it emits: all that a light tree needs.
struct BoundedLight {
    uint32_t id = 0;  ///< At most LIGHT_TREE_LEAF - 1; the tree picks it.
    Box bounds;
    double intensity = 0;  ///< Radiant intensity along the axis, luminance, W/sr; more than 0.
    glm::vec3 axis{0, 0, 1};
    float cosOrientation = 1;  ///< Half angle of a cone round the axis that has the directions it faces.
    float cosEmission = 0;     ///< Largest angle from these into which it emits.
    bool doubleSided = false;
};

/// A point or spot light; nothing for a directional or a black one.
std::optional<BoundedLight> boundedLight(const Light& light, uint32_t id);

/// An emissive triangle, or a parallelogram of which it is half. @param corners 3 or 4.
/// @param area m². @param radiance mean luminance, W/(m² sr).
BoundedLight boundedLight(std::span<const glm::vec3> corners, const glm::vec3& normal, double area, double radiance,
                          bool doubleSided, uint32_t id);

}  // namespace voxray
