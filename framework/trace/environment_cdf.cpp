#include "trace/environment_cdf.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/luminance.h"

namespace voxray {
namespace {

/// Mean luminance of each texel's bilinear patch.
std::vector<double> patchLuminances(const Environment& environment) {
    const ImageF& map = *environment.map;
    std::vector<double> means(map.pixelCount());
    for (int64_t y = 0; y < map.height; ++y)
        for (int64_t x = 0; x < map.width; ++x) {
            double sum = 0.0;
            for (int64_t dy = -1; dy <= 1; ++dy)
                for (int64_t dx = -1; dx <= 1; ++dx)
                    sum += double(luminance(environment.radiance * environmentTexel(map, x + dx, y + dy))) *
                           (dx == 0 ? 6 : 1) * (dy == 0 ? 6 : 1) / 64.0;
            means[size_t(y) * map.width + size_t(x)] = sum;
        }
    return means;
}

/// Cumulative probabilities of `count` weights of a positive sum.
void cumulate(const double* weights, uint32_t count, double total, float* cdf) {
    double sum = 0.0;
    for (uint32_t i = 0; i < count; ++i) {
        sum += weights[i] / total;
        cdf[i] = float(std::min(sum, 1.0));
    }
    cdf[count - 1] = 1.0f;
}

}  // namespace

glm::vec3 environmentTexel(const ImageF& map, int64_t x, int64_t y) {
    const float* p =
        map.pixel(uint32_t((x + map.width) % map.width), uint32_t(std::clamp<int64_t>(y, 0, int64_t(map.height) - 1)));
    return {p[0], p[1], p[2]};
}

EnvironmentCdf environmentCdf(const Environment& environment) {
    EnvironmentCdf cdf;
    cdf.meanLuminance = luminance(environment.radiance);
    if (!environment.map || !(cdf.meanLuminance > 0.0f)) return cdf;
    const uint32_t width = environment.map->width, height = environment.map->height;
    const std::vector<double> means = patchLuminances(environment);

    // Rows are weighted by solid angle
    std::vector<double> rowSums(height), rowWeights(height);
    double total = 0.0;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) rowSums[y] += means[size_t(y) * width + x];
        const double solidAngle =
            std::cos(std::numbers::pi * y / height) - std::cos(std::numbers::pi * (y + 1) / height);
        rowWeights[y] = rowSums[y] * solidAngle;
        total += rowWeights[y];
    }
    cdf.meanLuminance = float(total / (2.0 * width));
    if (!(total > 0.0)) return cdf;

    cdf.width = width;
    cdf.height = height;
    cdf.rows.resize(height);
    cumulate(rowWeights.data(), height, total, cdf.rows.data());
    cdf.columns.resize(means.size());
    const std::vector<double> even(width, 1.0);  // Of a black row, which is never picked
    for (uint32_t y = 0; y < height; ++y) {
        const bool isBlack = !(rowSums[y] > 0.0);
        cumulate(isBlack ? even.data() : &means[size_t(y) * width], width, isBlack ? double(width) : rowSums[y],
                 &cdf.columns[size_t(y) * width]);
    }
    return cdf;
}

}  // namespace voxray
