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

/// A score, with its 95 % confidence interval where it has one.
struct Estimate {
    Estimate(double score) : value(score) {}
    double value;
    std::optional<Interval> interval;
};

/// Mean of one value a pixel, over the pixels that count, with a percentile interval by bootstrap (Efron
/// 1979) over square tiles: neighbours are not independent, tiles of up to 16 x 16 pixels nearly are. Fewer
/// than 64 tiles of that size are made smaller. The same values give the same interval; no interval where
/// there is but one tile. @throws Error as countPixels().
Estimate meanOverTiles(const std::vector<double>& values, uint32_t width, uint32_t height, PixelMask mask);

}  // namespace voxray
