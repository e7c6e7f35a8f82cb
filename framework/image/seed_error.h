#pragma once

#include <span>

#include "image/score.h"

/// Bias and noise of a method apart, by two images of it that differ in their random numbers alone.
///
/// With images x and y, independent and with the same mean over random numbers, E x = E y = r + b against the
/// reference r: (x - r)(y - r) is b² on average, and (x - y)² / 2 is the variance v of either. The mean
/// squared error of an image is b² + v. Each (x - r)(y - r) is taken against the halves of the reference
/// (unbiased.h), so that noise of the reference adds nothing.
namespace voxray {

/// bias_nrmse and noise_nrmse: roots of the means of b² and v over pixels and channels, in units of the
/// reference's mean. Squared they add up to the mean of both images' squared nRMSE.
std::span<const MetricInfo> seedMetrics();

/// seedMetrics() with their intervals. @param first, second images of one size, the reference's.
/// @throws Error as the metrics (metrics.h).
Scores seedScores(const ImageF& first, const ImageF& second, const ReferenceHalves& reference,
                  PixelMask mask = {});

}  // namespace voxray
