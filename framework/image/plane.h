#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "image/image.h"

/// Common part of the metrics: single-channel planes in double precision, filters and deterministic sums.
namespace voxray {

/// One channel of an image, row 0 at the top.
struct Plane {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<double> data;  ///< width * height

    Plane() = default;
    Plane(uint32_t w, uint32_t h) : width(w), height(h), data(size_t(w) * h) {}

    double* row(size_t y) { return &data[y * width]; }
    const double* row(size_t y) const { return &data[y * width]; }
};

/// A filter along one axis: 2 r + 1 weights, the center one at offset 0.
using Kernel = std::vector<double>;

/// exp(-x² / (2 sigma²)) at x = -radius ... radius, summing to 1.
Kernel gaussianKernel(double sigma, int radius);

/// Correlates rows (X) or columns (Y) with a kernel; edges are repeated.
Plane filterX(const Plane& in, const Kernel& kernel);
Plane filterY(const Plane& in, const Kernel& kernel);

/// Calls body(y) for all rows, in parallel.
template <typename Body>
void parallelRows(uint32_t height, const Body& body) {
    parallelRanges(height, 8, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) body(y);
    });
}

/// Sum of rowSum(y) over all rows: computed in parallel, added in order.
template <typename RowSum>
double sumRows(uint32_t height, const RowSum& rowSum) {
    std::vector<double> sums(height);
    parallelRows(height, [&](size_t y) { sums[y] = rowSum(y); });
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum;
}

/// @throws Error unless both are 3-channel images of one size with finite values.
void checkPair(const ImageF& test, const ImageF& reference);
/// @param what names the image in the error, e.g. "reference image".
void checkFinite(const ImageF& image, const char* what);

}  // namespace voxray
