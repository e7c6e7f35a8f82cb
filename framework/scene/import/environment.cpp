#include "scene/import/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "base/interrupt.h"
#include "base/parallel.h"

namespace voxray {
namespace {

using std::numbers::pi;
/// Samples of a pixel along each side.
constexpr int kSamples = 4;

/// Environment's: u = 0.5 along -Z, u grows towards +X, v = 0 along +Y.
glm::dvec3 directionOf(double u, double v) {
    const double phi = (u - 0.5) * 2 * pi, theta = v * pi;
    return {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)};
}

/// Rotation and mirroring of a matrix, by the Gram-Schmidt process; the identity for a singular one.
glm::dmat3 orthogonal(const glm::dmat3& m) {
    const glm::dvec3 x = glm::normalize(m[0]);
    const glm::dvec3 y = glm::normalize(m[1] - x * glm::dot(x, m[1]));
    glm::dvec3 z = glm::cross(x, y);
    if (glm::dot(z, m[2]) < 0) z = -z;
    const double sum = glm::dot(x, x) + glm::dot(y, y) + glm::dot(z, z);
    return std::isfinite(sum) ? glm::dmat3(x, y, z) : glm::dmat3(1.0);
}

}  // namespace

std::shared_ptr<const ImageF> environmentMap(uint32_t height, const glm::dmat3& toMap, const RadianceAlong& radiance,
                                             MemoryBudget& memory) {
    const uint32_t width = 2 * height;
    memory.reserve(uint64_t(width) * height, 3 * sizeof(float));
    const glm::dmat3 turn = orthogonal(toMap);
    auto map = std::make_shared<ImageF>(width, height, 3u);
    parallelRanges(height, 1, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end && !interruptRequested(); ++y)
            for (uint32_t x = 0; x < width; ++x) {
                glm::dvec3 sum(0);
                double weights = 0;
                for (int j = 0; j < kSamples; ++j)
                    for (int i = 0; i < kSamples; ++i) {
                        const double u = (x + (i + 0.5) / kSamples) / width;
                        const double v = (double(y) + (j + 0.5) / kSamples) / height;
                        const double weight = std::sin(v * pi);
                        sum += weight * glm::dvec3(radiance(turn * directionOf(u, v)));
                        weights += weight;
                    }
                for (int c = 0; c < 3; ++c) map->pixel(x, uint32_t(y))[c] = float(sum[c] / weights);
            }
    });
    if (interruptRequested()) throw Interrupted();
    return map;
}

glm::vec3 bilinear(const ImageF& image, double u, double v, bool repeatU) {
    const double x = u * image.width - 0.5, y = std::clamp(v, 0.0, 1.0) * image.height - 0.5;
    const double left = std::floor(x), top = std::floor(y);
    const auto column = [&](double at) {
        const double width = image.width;
        return uint32_t(std::clamp(repeatU ? at - width * std::floor(at / width) : at, 0.0, width - 1));
    };
    const auto row = [&](double at) { return uint32_t(std::clamp(at, 0.0, double(image.height) - 1)); };
    const auto texel = [&](double atX, double atY) {
        const float* p = image.pixel(column(atX), row(atY));
        return glm::vec3(p[0], p[1], p[2]);
    };
    const auto fx = float(x - left), fy = float(y - top);
    return glm::mix(glm::mix(texel(left, top), texel(left + 1, top), fx),
                    glm::mix(texel(left, top + 1), texel(left + 1, top + 1), fx), fy);
}

glm::vec3 nearestTexel(const ImageF& image, double u, double v) {
    const auto at = [](double place, uint32_t size) {
        return uint32_t(std::clamp(place * size, 0.0, double(size) - 1));
    };
    const float* p = image.pixel(at(u - std::floor(u), image.width), at(v, image.height));
    return {p[0], p[1], p[2]};
}

glm::vec3 radianceOfMap(const ImageF& map, const glm::dvec3& direction) {
    const double u = std::atan2(direction.x, -direction.z) / (2 * pi) + 0.5;
    return bilinear(map, u, std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi, true);
}

Environment sumOfEnvironments(const Environment& a, const Environment& b) {
    if (!a.map && !b.map) return {a.radiance + b.radiance, nullptr};
    const auto isBlack = [](const Environment& e) { return e.radiance == glm::vec3(0); };
    if (isBlack(a)) return b;
    if (isBlack(b)) return a;
    const bool aIsFiner = a.map && (!b.map || a.map->height >= b.map->height);
    const Environment &fine = aIsFiner ? a : b, &other = aIsFiner ? b : a;
    auto sum = std::make_shared<ImageF>(*fine.map);
    for (uint32_t y = 0; y < sum->height; ++y)
        for (uint32_t x = 0; x < sum->width; ++x) {
            const double u = (x + 0.5) / sum->width, v = (y + 0.5) / sum->height;
            const glm::vec3 beside = other.radiance * (other.map ? bilinear(*other.map, u, v, true) : glm::vec3(1));
            float* pixel = sum->pixel(x, y);
            for (int c = 0; c < 3; ++c) pixel[c] = pixel[c] * fine.radiance[c] + beside[c];
        }
    return {glm::vec3(1), std::move(sum)};
}

}  // namespace voxray
