#pragma once

#include <glm/geometric.hpp>

#include "scene/geometry.h"
#include "scene/surface_offset.h"

namespace voxray {

/// Whether a ray of that direction hits a triangle's back side, where its vertices are in clockwise order.
inline bool isBackFacing(const Geometry& g, uint32_t triangle, const glm::vec3& direction) {
    const glm::uvec3 corners = g.triangles[triangle];
    const glm::vec3 a = g.positions[corners.x];
    return glm::dot(glm::cross(g.positions[corners.y] - a, g.positions[corners.z] - a), direction) > 0;
}

/// The same for single-sided triangles only.
inline bool isSingleSidedBack(const SceneState& state, uint32_t triangle, const glm::vec3& direction) {
    const Geometry& g = state.geometry;
    return !state.scene->materials[g.triangleMaterials[triangle]].doubleSided && isBackFacing(g, triangle, direction);
}

/// The unit normal of a triangle on the side that a ray of that direction hits.
inline glm::vec3 normalTowards(const Geometry& g, uint32_t triangle, const glm::vec3& direction) {
    const glm::uvec3 corners = g.triangles[triangle];
    const glm::vec3 a = g.positions[corners.x];
    // In double, since slivers underflow a float
    const glm::vec3 normal(
        glm::normalize(glm::cross(glm::dvec3(g.positions[corners.y] - a), glm::dvec3(g.positions[corners.z] - a))));
    return glm::dot(normal, direction) > 0 ? -normal : normal;
}

/// The origin for rays from a triangle at barycentrics (u, v): offset to the side that such a ray hits.
inline glm::vec3 pointTowards(const Geometry& g, uint32_t triangle, float u, float v, const glm::vec3& direction) {
    const glm::uvec3 corners = g.triangles[triangle];
    const glm::vec3 &a = g.positions[corners.x], &b = g.positions[corners.y], &c = g.positions[corners.z];
    const glm::vec3 point = a + (b - a) * u + (c - a) * v, normal = normalTowards(g, triangle, direction);
    return point + normal * std::max(planeOffset(a, b, c, normal), pointOffset(point));
}

}  // namespace voxray
