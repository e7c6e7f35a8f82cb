#include "image/plane.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace voxray {

Kernel gaussianKernel(double sigma, int radius) {
    Kernel kernel;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) {
        kernel.push_back(std::exp(-double(x) * x / (2 * sigma * sigma)));
        sum += kernel.back();
    }
    for (double& weight : kernel) weight /= sum;
    return kernel;
}

Plane filterX(const Plane& in, const Kernel& kernel) {
    const size_t radius = kernel.size() / 2;
    Plane out(in.width, in.height);
    parallelRanges(in.height, 8, [&](size_t begin, size_t end) {
        std::vector<double> padded(in.width + 2 * radius);
        for (size_t y = begin; y < end; ++y) {
            // Repeat the edges on both sides.
            const double* from = in.row(y);
            std::fill_n(padded.begin(), radius, from[0]);
            std::copy_n(from, in.width, padded.begin() + ptrdiff_t(radius));
            std::fill_n(padded.end() - ptrdiff_t(radius), radius, from[in.width - 1]);

            // Add the shifted row, weighted.
            double* to = out.row(y);
            for (size_t k = 0; k < kernel.size(); ++k) {
                const double weight = kernel[k];
                const double* shifted = &padded[k];
                for (size_t x = 0; x < in.width; ++x) to[x] += weight * shifted[x];
            }
        }
    });
    return out;
}

Plane filterY(const Plane& in, const Kernel& kernel) {
    const auto radius = int64_t(kernel.size() / 2);
    Plane out(in.width, in.height);
    parallelRows(in.height, [&](size_t y) {
        double* to = out.row(y);
        for (size_t k = 0; k < kernel.size(); ++k) {
            const double weight = kernel[k];
            const int64_t row = std::clamp<int64_t>(int64_t(y) + int64_t(k) - radius, 0, int64_t(in.height) - 1);
            const double* from = in.row(size_t(row));
            for (size_t x = 0; x < in.width; ++x) to[x] += weight * from[x];
        }
    });
    return out;
}

void checkFinite(const ImageF& image, const char* what) {
    for (size_t i = 0; i < image.data.size(); ++i) {
        if (std::isfinite(image.data[i])) continue;
        const size_t pixel = i / image.channels;
        throw Error("{} has {} at ({}, {})", what, std::isnan(image.data[i]) ? "NaN" : "an infinite value",
                    pixel % image.width, pixel / image.width);
    }
}

void checkPair(const ImageF& test, const ImageF& reference) {
    if (test.width != reference.width || test.height != reference.height)
        throw Error("test image is {} x {} pixels, reference image {} x {}: they must be equal", test.width,
                    test.height, reference.width, reference.height);
    if (test.channels != 3 || reference.channels != 3)
        throw Error("metrics need images of 3 channels, not {} and {}", test.channels, reference.channels);
    if (reference.pixelCount() == 0) throw Error("metrics need at least one pixel");
    checkFinite(test, "test image");
    checkFinite(reference, "reference image");
}

}  // namespace voxray
