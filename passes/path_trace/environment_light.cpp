#include "passes/path_trace/environment_light.h"

#include <algorithm>
#include <cmath>

#include "passes/path_trace/sampling.h"

namespace voxray::path_trace {

namespace {

/// Inverts a piecewise linear CDF: finds the interval that holds `u`, and u's `offset` in it, in [0, 1).
uint32_t sampleCdf(const float* cdf, uint32_t count, float u, float& offset) {
    const float* upper = std::upper_bound(cdf, cdf + count + 1, u);
    const auto i = uint32_t(std::clamp<ptrdiff_t>(upper - cdf - 1, 0, ptrdiff_t(count) - 1));
    const float width = cdf[i + 1] - cdf[i];
    offset = width > 0.0f ? std::clamp((u - cdf[i]) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;
    return i;
}

/// A texel of a map that repeats horizontally and is clamped vertically; x at least -width.
glm::vec3 texelAt(const ImageF& map, int64_t x, int64_t y) {
    const float* p =
        map.pixel(uint32_t((x + map.width) % map.width), uint32_t(std::clamp<int64_t>(y, 0, int64_t(map.height) - 1)));
    return {p[0], p[1], p[2]};
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment) : environment_(&environment) {
    isBlack_ = !(maxComponent(environment.radiance) > 0.0f);
    meanLuminance_ = luminance(environment.radiance);
    if (isBlack_ || !environment.map) return;
    const ImageF& map = *environment.map;
    width_ = map.width;
    height_ = map.height;

    // Mean luminance of each texel's bilinear patch: positive where its radiance is
    std::vector<double> weights(size_t(width_) * height_);
    const auto brightness = [&](int64_t x, int64_t y) {
        return double(luminance(environment.radiance * texelAt(map, x, y)));
    };
    for (int64_t y = 0; y < height_; ++y)
        for (int64_t x = 0; x < width_; ++x) {
            double sum = 0.0;
            for (int64_t dy = -1; dy <= 1; ++dy)
                for (int64_t dx = -1; dx <= 1; ++dx)
                    sum += brightness(x + dx, y + dy) * (dx == 0 ? 6 : 1) * (dy == 0 ? 6 : 1) / 64.0;
            weights[size_t(y) * width_ + size_t(x)] = sum;
        }

    // CDFs of columns, and of rows weighted by solid angle
    columnCdfs_.resize((size_t(width_) + 1) * height_);
    rowCdf_.resize(size_t(height_) + 1);
    std::vector<double> rowWeights(height_);
    double total = 0.0;
    for (uint32_t y = 0; y < height_; ++y) {
        const double* row = &weights[size_t(y) * width_];
        double rowTotal = 0.0;
        for (uint32_t x = 0; x < width_; ++x) rowTotal += row[x];
        float* cdf = &columnCdfs_[size_t(y) * (width_ + 1)];
        double sum = 0.0;
        for (uint32_t x = 0; x < width_; ++x) {
            sum += rowTotal > 0.0 ? row[x] / rowTotal : 1.0 / width_;
            cdf[x + 1] = float(std::min(sum, 1.0));
        }
        cdf[width_] = 1.0f;
        const double solidAngle = std::cos(kPi * y / height_) - std::cos(kPi * (y + 1) / height_);
        rowWeights[y] = rowTotal * solidAngle;
        total += rowWeights[y];
    }
    isBlack_ = !(total > 0.0);
    meanLuminance_ = float(total / (2.0 * width_));
    double sum = 0.0;
    for (uint32_t y = 0; y < height_ && !isBlack_; ++y) {
        sum += rowWeights[y] / total;
        rowCdf_[y + 1] = float(std::min(sum, 1.0));
    }
    rowCdf_[height_] = 1.0f;
}

glm::vec2 EnvironmentLight::texelCoordinates(const glm::vec3& d) const {
    const float u = 0.5f + std::atan2(d.x, -d.z) * (0.5f * kInvPi);
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) * kInvPi;
    return {u * float(width_), v * float(height_)};
}

glm::vec3 EnvironmentLight::radiance(const glm::vec3& direction) const {
    if (!hasMap()) return environment_->radiance;
    const ImageF& map = *environment_->map;
    const glm::vec2 p = texelCoordinates(direction) - 0.5f;
    const float floorX = std::floor(p.x), floorY = std::floor(p.y);
    const float fx = p.x - floorX, fy = p.y - floorY;
    const auto x = int64_t(floorX), y = int64_t(floorY);
    const glm::vec3 top = texelAt(map, x, y) * (1.0f - fx) + texelAt(map, x + 1, y) * fx;
    const glm::vec3 bottom = texelAt(map, x, y + 1) * (1.0f - fx) + texelAt(map, x + 1, y + 1) * fx;
    return environment_->radiance * (top * (1.0f - fy) + bottom * fy);
}

float EnvironmentLight::texelPdf(uint32_t x, uint32_t y, float sinTheta) const {
    const float* cdf = &columnCdfs_[size_t(y) * (width_ + 1)];
    const float density = (cdf[x + 1] - cdf[x]) * float(width_) * (rowCdf_[y + 1] - rowCdf_[y]) * float(height_);
    return sinTheta > 0.0f ? density / (2.0f * kPi * kPi * sinTheta) : 0.0f;
}

float EnvironmentLight::pdf(const glm::vec3& direction) const {
    const glm::vec2 p = texelCoordinates(direction);
    const auto x = std::min(uint32_t(std::max(p.x, 0.0f)), width_ - 1);
    const auto y = std::min(uint32_t(std::max(p.y, 0.0f)), height_ - 1);
    return texelPdf(x, y, std::sqrt(std::max(0.0f, 1.0f - direction.y * direction.y)));
}

glm::vec3 EnvironmentLight::sample(float u, float v, float& pdf) const {
    float offsetX, offsetY;
    const uint32_t y = sampleCdf(rowCdf_.data(), height_, v, offsetY);
    const uint32_t x = sampleCdf(&columnCdfs_[size_t(y) * (width_ + 1)], width_, u, offsetX);
    const float theta = kPi * (float(y) + offsetY) / float(height_);
    const float phi = 2.0f * kPi * ((float(x) + offsetX) / float(width_) - 0.5f);
    const float sinTheta = std::sin(theta);
    pdf = texelPdf(x, y, sinTheta);
    return {sinTheta * std::sin(phi), std::cos(theta), -sinTheta * std::cos(phi)};
}

}  // namespace voxray::path_trace
