#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray::test {

using Triangle = std::array<glm::dvec3, 3>;

/// Whether a triangle meets a cube, closed, by all 13 separating axes (Akenine-Möller 2001).
inline bool overlaps(const Triangle& t, glm::dvec3 center, double half) {
    std::array<glm::dvec3, 13> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, glm::cross(t[1] - t[0], t[2] - t[0])}};
    for (size_t e = 0; e < 3; ++e)
        for (size_t k = 0; k < 3; ++k) axes[4 + 3 * e + k] = glm::cross(axes[k], t[(e + 1) % 3] - t[e]);
    for (const glm::dvec3& axis : axes) {
        if (glm::length(axis) < 1e-12) continue;
        const double a = glm::dot(axis, t[0] - center), b = glm::dot(axis, t[1] - center),
                     c = glm::dot(axis, t[2] - center);
        const double reach = half * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        if (std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach) return false;
    }
    return true;
}

/// The polygon of a triangle's part in a box.
inline std::vector<glm::dvec3> partInBox(const Triangle& triangle, const glm::dvec3& low, const glm::dvec3& high) {
    const auto& [a, b, c] = triangle;
    if (glm::any(glm::greaterThan(glm::min(a, glm::min(b, c)), high)) ||
        glm::any(glm::lessThan(glm::max(a, glm::max(b, c)), low)))
        return {};
    std::vector<glm::dvec3> polygon{a, b, c};
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {-1.0, 1.0}) {
            std::vector<glm::dvec3> left;
            const double limit = sign > 0 ? high[axis] : -low[axis];
            for (size_t i = 0; i < polygon.size(); ++i) {
                const glm::dvec3 from = polygon[i], to = polygon[(i + 1) % polygon.size()];
                const double outFrom = sign * from[axis] - limit, outTo = sign * to[axis] - limit;
                if (outFrom <= 0) left.push_back(from);
                if (outFrom * outTo < 0) left.push_back(glm::mix(from, to, outFrom / (outFrom - outTo)));
            }
            polygon = left;
        }
    return polygon;
}

inline double areaInBox(const Triangle& triangle, const glm::dvec3& low, const glm::dvec3& high) {
    const std::vector<glm::dvec3> polygon = partInBox(triangle, low, high);
    glm::dvec3 sum(0);
    for (size_t i = 2; i < polygon.size(); ++i) sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * glm::length(sum);
}

/// A scene's triangles in voxels of a grid.
inline std::vector<Triangle> trianglesInVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid) {
    std::vector<Triangle> triangles(geometry.triangles.size());
    for (size_t t = 0; t < triangles.size(); ++t)
        for (int k = 0; k < 3; ++k)
            triangles[t][size_t(k)] =
                (glm::dvec3(geometry.positions[geometry.triangles[t][k]]) - glm::dvec3(grid.origin)) /
                double(grid.voxelSize);
    return triangles;
}

}  // namespace voxray::test
