#include "passes/path_trace/environment_light.h"

#include <algorithm>
#include <cmath>

#include "passes/path_trace/sampling.h"

namespace voxray::path_trace {

namespace {

/// Inverts a piecewise linear CDF: finds the interval that holds `u`, and u's `offset` in it, in [0, 1).
uint32_t sampleCdf(const float* cdf, uint32_t count, float u, float& offset) {
    const auto i = uint32_t(std::min<ptrdiff_t>(std::upper_bound(cdf, cdf + count, u) - cdf, ptrdiff_t(count) - 1));
    const float lower = i > 0 ? cdf[i - 1] : 0.0f, width = cdf[i] - lower;
    offset = width > 0.0f ? std::clamp((u - lower) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;
    return i;
}

/// Probability of an interval.
float probability(const float* cdf, uint32_t i) {
    return cdf[i] - (i > 0 ? cdf[i - 1] : 0.0f);
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment)
    : environment_(&environment), cdf_(environmentCdf(environment)) {}

glm::vec2 EnvironmentLight::texelCoordinates(const glm::vec3& d) const {
    const float u = 0.5f + std::atan2(d.x, -d.z) * (0.5f * kInvPi);
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) * kInvPi;
    return {u * float(environment_->map->width), v * float(environment_->map->height)};
}

glm::vec3 EnvironmentLight::radiance(const glm::vec3& direction) const {
    if (!environment_->map) return environment_->radiance;
    const ImageF& map = *environment_->map;
    const glm::vec2 p = texelCoordinates(direction) - 0.5f;
    const float floorX = std::floor(p.x), floorY = std::floor(p.y);
    const float fx = p.x - floorX, fy = p.y - floorY;
    const auto x = int64_t(floorX), y = int64_t(floorY);
    const glm::vec3 top = environmentTexel(map, x, y) * (1.0f - fx) + environmentTexel(map, x + 1, y) * fx;
    const glm::vec3 bottom = environmentTexel(map, x, y + 1) * (1.0f - fx) + environmentTexel(map, x + 1, y + 1) * fx;
    return environment_->radiance * (top * (1.0f - fy) + bottom * fy);
}

float EnvironmentLight::texelPdf(uint32_t x, uint32_t y, float sinTheta) const {
    const float density = probability(&cdf_.columns[size_t(y) * cdf_.width], x) * float(cdf_.width) *
                          probability(cdf_.rows.data(), y) * float(cdf_.height);
    return sinTheta > 0.0f ? density / (2.0f * kPi * kPi * sinTheta) : 0.0f;
}

float EnvironmentLight::pdf(const glm::vec3& direction) const {
    const glm::vec2 p = texelCoordinates(direction);
    const auto x = std::min(uint32_t(std::max(p.x, 0.0f)), cdf_.width - 1);
    const auto y = std::min(uint32_t(std::max(p.y, 0.0f)), cdf_.height - 1);
    return texelPdf(x, y, std::sqrt(std::max(0.0f, 1.0f - direction.y * direction.y)));
}

glm::vec3 EnvironmentLight::sample(float u, float v, float& pdf) const {
    float offsetX, offsetY;
    const uint32_t y = sampleCdf(cdf_.rows.data(), cdf_.height, v, offsetY);
    const uint32_t x = sampleCdf(&cdf_.columns[size_t(y) * cdf_.width], cdf_.width, u, offsetX);
    const float theta = kPi * (float(y) + offsetY) / float(cdf_.height);
    const float phi = 2.0f * kPi * ((float(x) + offsetX) / float(cdf_.width) - 0.5f);
    const float sinTheta = std::sin(theta);
    pdf = texelPdf(x, y, sinTheta);
    return {sinTheta * std::sin(phi), std::cos(theta), -sinTheta * std::cos(phi)};
}

}  // namespace voxray::path_trace
