#pragma once

#include "image/bootstrap.h"
#include "image/image.h"

/// Errors without the reference's noise. The reference is the mean m of two independent halves a and b, each
/// with the expected value r. The expected value of a function T(m) exceeds T(r) by T''(r)/2 Var(m), and
/// ((a-b)/2)² is an unbiased estimate of Var(m): subtracted, it leaves the error against r. Formulas:
/// docs/units.md.
namespace voxray {

/// Two independent estimates of a reference with equal variance. Both images must outlive it.
struct ReferenceHalves {
    const ImageF& a;
    const ImageF& b;
};

/// nRmse() without the reference's noise, with a 95 % confidence interval: root of the mean of (x-a)(x-b),
/// which is unbiased, over the mean of m. Negative mean squares and ends of the interval are clamped to 0.
/// @throws Error as the metrics.
Estimate nRmse(const ImageF& test, const ReferenceHalves& reference, PixelMask mask = {});
/// relMse() likewise, to first order in Var(m), since the denominator is noisy, too. The interval includes
/// that of the jackknife (Quenouille 1956), which is correct to the same order: their difference shows the
/// next order.
Estimate relMse(const ImageF& test, const ReferenceHalves& reference, PixelMask mask = {});

/// Root of a mean square and of its interval, clamped to 0.
Estimate rootOf(const Estimate& meanSquare, double scale);

}  // namespace voxray
