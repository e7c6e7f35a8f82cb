#include "image/unbiased.h"

#include <algorithm>
#include <cmath>

#include "image/plane.h"

namespace voxray {
namespace {

/// Applies an increasing function to a score and to the ends of its interval.
template <typename F>
Estimate mapped(const Estimate& from, const F& f) {
    Estimate to(f(from.value));
    if (from.interval) to.interval = {f(from.interval->low), f(from.interval->high)};
    return to;
}

/// Mean of f(test value, value of half a, value of half b), images multiplied by `scale`.
template <typename F>
Estimate meanOf(const ImageF& test, const ReferenceHalves& reference, PixelMask mask, double scale, const F& f) {
    std::vector<double> errors(test.pixelCount());
    parallelRows(test.height, [&](size_t y) {
        for (size_t pixel = y * test.width; pixel < (y + 1) * test.width; ++pixel)
            for (size_t i = 3 * pixel; i < 3 * pixel + 3; ++i)
                errors[pixel] += f(scale * double(test.data[i]), scale * double(reference.a.data[i]),
                                   scale * double(reference.b.data[i])) /
                                 3;
    });
    return meanOverTiles(errors, test.width, test.height, mask);
}

double scaleOf(const ImageF& test, const ReferenceHalves& reference, PixelMask mask) {
    checkPair(test, reference.a);
    checkPair(test, reference.b);
    return unitScale(0.5 * (meanValue(reference.a, mask) + meanValue(reference.b, mask)));
}

}  // namespace

Estimate rootOf(const Estimate& meanSquare, double scale) {
    return mapped(meanSquare, [scale](double square) { return scale * std::sqrt(std::max(square, 0.0)); });
}

Estimate nRmse(const ImageF& test, const ReferenceHalves& reference, PixelMask mask) {
    const double scale = scaleOf(test, reference, mask);
    return rootOf(meanOf(test, reference, mask, scale, [](double x, double a, double b) { return (x - a) * (x - b); }),
                  1);
}

Estimate relMse(const ImageF& test, const ReferenceHalves& reference, PixelMask mask) {
    const double scale = scaleOf(test, reference, mask);
    const auto errorAgainst = [](double x, double r) { return (x - r) * (x - r) / (r * r + relMseOffset); };
    const Estimate expanded = meanOf(test, reference, mask, scale, [&](double x, double a, double b) {
        // Half of the second derivative of e² / q
        const double m = 0.5 * (a + b), d = 0.5 * (a - b), e = x - m, q = m * m + relMseOffset;
        const double halfCurvature = 1 / q + 4 * e * m / (q * q) + e * e * (4 * m * m - q) / (q * q * q);
        return errorAgainst(x, m) - halfCurvature * d * d;
    });
    const Estimate jackknife = meanOf(test, reference, mask, scale, [&](double x, double a, double b) {
        return 2 * errorAgainst(x, 0.5 * (a + b)) - 0.5 * (errorAgainst(x, a) + errorAgainst(x, b));
    });

    // The two differ if the noise is not small
    Estimate combined(expanded.value);
    if (expanded.interval)
        combined.interval = {std::min(expanded.interval->low, jackknife.interval->low),
                             std::max(expanded.interval->high, jackknife.interval->high)};
    return mapped(combined, [](double value) { return std::max(value, 0.0); });
}

}  // namespace voxray
