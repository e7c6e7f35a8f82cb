#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "scene/geometry.h"
#include "shaders/scene/scene_types.h"

namespace voxray {

/// Offset of ray origins from a surface, m, as in shaders/scene/surface_offset.glsl. From a point alone;
/// never 0.
inline float pointOffset(const glm::vec3& position) {
    const glm::vec3 size = glm::abs(position);
    return COORDINATE_ERROR * std::max({size.x, size.y, size.z, 1e-20f});
}

/// From a triangle's plane.
inline float planeOffset(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& normal) {
    return COORDINATE_ERROR * glm::dot(glm::abs(normal), glm::max(glm::abs(a), glm::max(glm::abs(b), glm::abs(c))));
}

}  // namespace voxray
