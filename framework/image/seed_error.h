#pragma once

#include <span>

#include "image/score.h"

/// Bias and noise of a method, estimated from two images with different random numbers.
///
/// With images x and y, independent and with the same mean over random numbers, E x = E y = r + b against the
/// reference r: (x - r)(y - r) is b² on average, and (x - y)² / 2 is the variance v of either. The mean
/// squared error of an image is b² + v. The factors (x - r) and (y - r) use different halves of the reference
/// (unbiased.h), so that its noise doesn't contribute.
namespace voxray {

/// bias_nrmse and noise_nrmse: roots of the means of b² and v over pixels and channels, in units of the
/// reference's mean. Their squares add up to the mean squared nRMSE of both images.
std::span<const MetricInfo> seedMetrics();

/// seedMetrics() with their intervals. @param first, second images of one size, the reference's.
/// @throws Error as the metrics (metrics.h).
Scores seedScores(const ImageF& first, const ImageF& second, const ReferenceHalves& reference, PixelMask mask = {});

}  // namespace voxray
