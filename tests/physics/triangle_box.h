#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

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

}  // namespace voxray::test
