#include "image/metrics.h"
#include "image/plane.h"

namespace voxray {

namespace {

constexpr int windowRadius = 5;
constexpr double windowSigma = 1.5;

Plane luma(const ImageF& display) {
    Plane plane(display.width, display.height);
    parallelRows(display.height, [&](size_t y) {
        const float* from = display.pixel(0, uint32_t(y));
        double* to = plane.row(y);
        for (size_t x = 0; x < display.width; ++x, from += 3)
            to[x] = 0.2126 * double(from[0]) + 0.7152 * double(from[1]) + 0.0722 * double(from[2]);
    });
    return plane;
}

Plane product(const Plane& a, const Plane& b) {
    Plane plane(a.width, a.height);
    parallelRows(a.height, [&](size_t y) {
        for (size_t x = 0; x < a.width; ++x) plane.row(y)[x] = a.row(y)[x] * b.row(y)[x];
    });
    return plane;
}

}  // namespace

double ssim(const ImageF& testDisplay, const ImageF& referenceDisplay, PixelMask mask) {
    checkPair(testDisplay, referenceDisplay);

    // Means, squares and products in the Gaussian window round each pixel.
    const Kernel window = gaussianKernel(windowSigma, windowRadius);
    const auto blur = [&](const Plane& plane) { return filterY(filterX(plane, window), window); };
    const Plane test = luma(testDisplay), reference = luma(referenceDisplay);
    const Plane meanX = blur(test), meanR = blur(reference);
    const Plane meanXX = blur(product(test, test)), meanRR = blur(product(reference, reference));
    const Plane meanXR = blur(product(test, reference));

    // Pixels whose window is within the image; under a mask all of its pixels.
    const auto cropOf = [&](uint32_t size) {
        return mask.empty() && size > 2 * windowRadius ? size_t(windowRadius) : size_t(0);
    };
    const size_t cropX = cropOf(test.width), cropY = cropOf(test.height);
    const size_t columns = test.width - 2 * cropX, rows = test.height - 2 * cropY;

    // Mean of the index (equation 13 of the paper).
    constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const size_t count = mask.empty() ? columns * rows : countPixels(test.width, test.height, mask);
    const double sum = sumRows(uint32_t(rows), [&](size_t row) {
        const size_t y = row + cropY;
        double rowSum = 0;
        for (size_t x = cropX; x < cropX + columns; ++x) {
            if (!mask.empty() && !mask[y * test.width + x]) continue;
            const double x1 = meanX.row(y)[x], r1 = meanR.row(y)[x];
            const double varianceX = meanXX.row(y)[x] - x1 * x1;
            const double varianceR = meanRR.row(y)[x] - r1 * r1;
            const double covariance = meanXR.row(y)[x] - x1 * r1;
            rowSum +=
                (2 * x1 * r1 + c1) * (2 * covariance + c2) / ((x1 * x1 + r1 * r1 + c1) * (varianceX + varianceR + c2));
        }
        return rowSum;
    });
    return sum / double(count);
}

}  // namespace voxray
