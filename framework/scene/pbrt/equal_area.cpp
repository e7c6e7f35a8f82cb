#include "scene/pbrt/equal_area.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxray::pbrt {

glm::dvec2 squareOfDirection(const glm::dvec3& d) {
    const double x = std::abs(d.x), y = std::abs(d.y);
    const double radius = std::sqrt(std::max(1 - std::abs(d.z), 0.0));
    const double share = x == 0 && y == 0 ? 0 : std::atan2(y, x) * 2 / std::numbers::pi;
    glm::dvec2 p(radius * (1 - share), radius * share);
    if (d.z < 0) p = {1 - p.y, 1 - p.x};
    return {0.5 * (std::copysign(p.x, d.x) + 1), 0.5 * (std::copysign(p.y, d.y) + 1)};
}

glm::dvec3 directionOfSquare(const glm::dvec2& uv) {
    const glm::dvec2 p(2 * uv.x - 1, 2 * uv.y - 1);
    const double x = std::abs(p.x), y = std::abs(p.y);
    const double side = 1 - (x + y);  // Above 0 in the upper hemisphere
    const double radius = 1 - std::abs(side);
    const double angle = (radius == 0 ? 1 : (y - x) / radius + 1) * std::numbers::pi / 4;
    const double flat = radius * std::sqrt(std::max(2 - radius * radius, 0.0));
    return {std::copysign(std::cos(angle) * flat, p.x), std::copysign(std::sin(angle) * flat, p.y),
            std::copysign(1 - radius * radius, side)};
}

glm::vec3 texelAlong(const ImageF& map, const glm::dvec3& direction) {
    const glm::dvec2 uv = squareOfDirection(direction);
    const auto texel = [](double at, uint32_t size) { return uint32_t(std::clamp(at * size, 0.0, double(size) - 1)); };
    const float* pixel = map.pixel(texel(uv.x, map.width), texel(uv.y, map.height));
    return {pixel[0], pixel[1], pixel[2]};
}

}  // namespace voxray::pbrt
