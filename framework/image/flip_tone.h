#pragma once

#include <algorithm>
#include <cmath>

/// The tone map of HDR-FLIP (Andersson et al. 2021): Narkowicz's fit of the ACES curve,
/// y = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), at 0.6 x, which undoes the fit's exposure.
namespace voxray {

namespace flip_aces {
inline constexpr double a = 0.6 * 0.6 * 2.51, b = 0.6 * 0.03;
inline constexpr double c = 0.6 * 0.6 * 2.43, d = 0.6 * 0.59, e = 0.14;
}  // namespace flip_aces

/// Linear radiance (negative counts as 0) to linear display values in [0, 1].
inline double aces(double x) {
    using namespace flip_aces;
    x = std::clamp(x, 0.0, 1e100);
    return std::min(x * (a * x + b) / (x * (c * x + d) + e), 1.0);
}

/// The radiance that aces() maps to y, for y in [0, 1].
inline double acesInverse(double y) {
    // The positive root of (a - c y) x² + (b - d y) x - e y = 0.
    using namespace flip_aces;
    const double p = (b - d * y) / (a - c * y) / 2, q = -e * y / (a - c * y);
    return -p + std::sqrt(p * p - q);
}

}  // namespace voxray
