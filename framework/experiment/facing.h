#pragma once

#include <glm/geometric.hpp>

#include "scene/geometry.h"

namespace voxray {

/// Whether a ray of that direction meets a triangle's back, the side from which its corners run clockwise.
inline bool showsBack(const Geometry& g, uint32_t triangle, const glm::vec3& direction) {
    const glm::uvec3 corners = g.triangles[triangle];
    const glm::vec3 a = g.positions[corners.x];
    return glm::dot(glm::cross(g.positions[corners.y] - a, g.positions[corners.z] - a), direction) > 0;
}

/// The unit normal of the side of a triangle that a ray of that direction meets.
inline glm::vec3 normalTowards(const Geometry& g, uint32_t triangle, const glm::vec3& direction) {
    const glm::uvec3 corners = g.triangles[triangle];
    const glm::vec3 a = g.positions[corners.x];
    const glm::vec3 normal =
        glm::normalize(glm::cross(g.positions[corners.y] - a, g.positions[corners.z] - a));
    return glm::dot(normal, direction) > 0 ? -normal : normal;
}

}  // namespace voxray
