#include "passes/path_trace/environment_light.h"

#include <algorithm>
#include <cmath>

#include "passes/path_trace/sampling.h"

namespace voxray::path_trace {

namespace {

/// Finds the interval of a cumulative sum that holds `u`; `rest` is u's place in the interval, in [0, 1).
uint32_t invert(const float* sums, uint32_t count, float u, float& rest) {
    const float* upper = std::upper_bound(sums, sums + count + 1, u);
    const auto i = uint32_t(std::clamp<ptrdiff_t>(upper - sums - 1, 0, ptrdiff_t(count) - 1));
    const float width = sums[i + 1] - sums[i];
    rest = width > 0.0f ? std::clamp((u - sums[i]) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;
    return i;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Environment& environment) : environment_(&environment) {
    black_ = !(maxComponent(environment.radiance) > 0.0f);
    meanLuminance_ = luminance(environment.radiance);
    if (black_ || !environment.map) return;
    const ImageF& map = *environment.map;
    width_ = map.width;
    height_ = map.height;

    // Mean brightness of each texel's bilinear patch: never zero where its radiance isn't.
    std::vector<double> weights(size_t(width_) * height_);
    const auto brightness = [&](int64_t x, int64_t y) {
        const float* p = map.pixel(uint32_t((x + width_) % width_),
                                   uint32_t(std::clamp<int64_t>(y, 0, int64_t(height_) - 1)));
        return double(luminance(environment.radiance * glm::vec3(p[0], p[1], p[2])));
    };
    for (int64_t y = 0; y < height_; ++y)
        for (int64_t x = 0; x < width_; ++x) {
            double sum = 0.0;
            for (int64_t dy = -1; dy <= 1; ++dy)
                for (int64_t dx = -1; dx <= 1; ++dx)
                    sum += brightness(x + dx, y + dy) * (dx == 0 ? 6 : 1) * (dy == 0 ? 6 : 1) / 64.0;
            weights[size_t(y) * width_ + size_t(x)] = sum;
        }

    // Cumulative sums, rows weighed by the solid angle that they cover.
    columnSums_.resize((size_t(width_) + 1) * height_);
    rowSums_.resize(size_t(height_) + 1);
    std::vector<double> rows(height_);
    double total = 0.0;
    for (uint32_t y = 0; y < height_; ++y) {
        const double* row = &weights[size_t(y) * width_];
        double rowTotal = 0.0;
        for (uint32_t x = 0; x < width_; ++x) rowTotal += row[x];
        float* sums = &columnSums_[size_t(y) * (width_ + 1)];
        double sum = 0.0;
        for (uint32_t x = 0; x < width_; ++x) {
            sum += rowTotal > 0.0 ? row[x] / rowTotal : 1.0 / width_;
            sums[x + 1] = float(std::min(sum, 1.0));
        }
        sums[width_] = 1.0f;
        const double solidAngle = std::cos(kPi * y / height_) - std::cos(kPi * (y + 1) / height_);
        rows[y] = rowTotal * solidAngle;
        total += rows[y];
    }
    black_ = !(total > 0.0);
    meanLuminance_ = float(total / (2.0 * width_));
    double sum = 0.0;
    for (uint32_t y = 0; y < height_ && !black_; ++y) {
        sum += rows[y] / total;
        rowSums_[y + 1] = float(std::min(sum, 1.0));
    }
    rowSums_[height_] = 1.0f;
}

glm::vec2 EnvironmentLight::toMap(const glm::vec3& d) const {
    const float u = 0.5f + std::atan2(d.x, -d.z) * (0.5f * kInvPi);
    const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) * kInvPi;
    return {u * float(width_), v * float(height_)};
}

glm::vec3 EnvironmentLight::radiance(const glm::vec3& direction) const {
    if (!hasMap()) return environment_->radiance;
    const ImageF& map = *environment_->map;
    const glm::vec2 p = toMap(direction) - 0.5f;
    const float floorX = std::floor(p.x), floorY = std::floor(p.y);
    const float fx = p.x - floorX, fy = p.y - floorY;
    const auto texel = [&](int64_t x, int64_t y) {
        const float* t = map.pixel(uint32_t((x + width_) % width_),
                                   uint32_t(std::clamp<int64_t>(y, 0, int64_t(height_) - 1)));
        return glm::vec3(t[0], t[1], t[2]);
    };
    const auto x = int64_t(floorX), y = int64_t(floorY);
    const glm::vec3 top = texel(x, y) * (1.0f - fx) + texel(x + 1, y) * fx;
    const glm::vec3 bottom = texel(x, y + 1) * (1.0f - fx) + texel(x + 1, y + 1) * fx;
    return environment_->radiance * (top * (1.0f - fy) + bottom * fy);
}

float EnvironmentLight::pdfOfTexel(uint32_t x, uint32_t y, float sinTheta) const {
    const float* sums = &columnSums_[size_t(y) * (width_ + 1)];
    const float density =
        (sums[x + 1] - sums[x]) * float(width_) * (rowSums_[y + 1] - rowSums_[y]) * float(height_);
    return sinTheta > 0.0f ? density / (2.0f * kPi * kPi * sinTheta) : 0.0f;
}

float EnvironmentLight::pdf(const glm::vec3& direction) const {
    const glm::vec2 p = toMap(direction);
    const auto x = std::min(uint32_t(std::max(p.x, 0.0f)), width_ - 1);
    const auto y = std::min(uint32_t(std::max(p.y, 0.0f)), height_ - 1);
    return pdfOfTexel(x, y, std::sqrt(std::max(0.0f, 1.0f - direction.y * direction.y)));
}

glm::vec3 EnvironmentLight::sample(float u, float v, float& pdf) const {
    float restX, restY;
    const uint32_t y = invert(rowSums_.data(), height_, v, restY);
    const uint32_t x = invert(&columnSums_[size_t(y) * (width_ + 1)], width_, u, restX);
    const float theta = kPi * (float(y) + restY) / float(height_);
    const float phi = 2.0f * kPi * ((float(x) + restX) / float(width_) - 0.5f);
    const float sinTheta = std::sin(theta);
    pdf = pdfOfTexel(x, y, sinTheta);
    return {sinTheta * std::sin(phi), std::cos(theta), -sinTheta * std::cos(phi)};
}

}  // namespace voxray::path_trace
