#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "image/metrics.h"

/// Confidence intervals of means over an image.
namespace voxray {

struct Interval {
    double low = 0;
    double high = 0;
};

/// A score, with its 95 % confidence interval, if any.
struct Estimate {
    Estimate(double score) : value(score) {}
    double value;
    std::optional<Interval> interval;
};

/// Mean of one value per pixel under the mask, with a percentile interval by block bootstrap (Efron 1979)
/// over square tiles of 16 x 16 pixels, which are nearly independent, unlike adjacent pixels. Tiles are
/// smaller if there were fewer than 64. Deterministic; no interval for a single tile. @throws Error as
/// countPixels().
Estimate meanOverTiles(const std::vector<double>& values, uint32_t width, uint32_t height, PixelMask mask);

}  // namespace voxray
