#pragma once

#include "image/bootstrap.h"
#include "image/image.h"

/// Errors freed of the reference's noise. The reference is the mean m of two independent halves a and b, each
/// the true value r on average. A function T(m) of it is T''(r)/2 Var(m) too large on average, and ((a-b)/2)²
/// is an unbiased estimate of Var(m); taken off, what is left is the error against r itself. docs/units.md
/// has the formulas.
namespace voxray {

/// Two estimates of one reference that are independent and equally noisy. Both must outlive it.
struct ReferenceHalves {
    const ImageF& a;
    const ImageF& b;
};

/// nRmse() against the reference without its noise, with a 95 % confidence interval: root of the mean of
/// (x-a)(x-b), which is unbiased, over the mean of m. A mean square that noise makes negative counts as 0,
/// and so do ends of the interval. @throws Error as the metrics.
Estimate nRmse(const ImageF& test, const ReferenceHalves& reference, PixelMask mask = {});
/// The same of relMse(), to first order in Var(m), for the denominator has noise too. The interval spans that
/// of the jackknife (Quenouille 1956), which is right to the same order: where they part, the next order
/// shows.
Estimate relMse(const ImageF& test, const ReferenceHalves& reference, PixelMask mask = {});

/// Root of a mean square and of its interval; 0 where they are negative.
Estimate rootOf(const Estimate& meanSquare, double scale);

}  // namespace voxray
