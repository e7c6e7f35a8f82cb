#include "image/metrics.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "image/plane.h"

namespace voxray {

namespace {

// Mean of f(test value, reference value) over all values of the pixels that count.
template <typename F>
double meanOf(const ImageF& test, const ImageF& reference, PixelMask mask, const F& f) {
    const size_t count = countPixels(reference.width, reference.height, mask);
    const size_t rowValues = size_t(reference.width) * reference.channels;
    const double sum = sumRows(reference.height, [&](size_t y) {
        const float* x = &test.data[y * rowValues];
        const float* r = &reference.data[y * rowValues];
        const uint8_t* counts = mask.empty() ? nullptr : &mask[y * reference.width];
        double rowSum = 0;
        for (size_t i = 0; i < rowValues; ++i)
            if (!counts || counts[i / reference.channels]) rowSum += f(double(x[i]), double(r[i]));
        return rowSum;
    });
    return sum / double(count * reference.channels);
}

}  // namespace

double meanValue(const ImageF& image, PixelMask mask) {
    return meanOf(image, image, mask, [](double x, double) { return x; });
}

double unitScale(double referenceMean) {
    return referenceMean > 0 ? 1 / referenceMean : 1;
}

size_t countPixels(uint32_t width, uint32_t height, PixelMask mask) {
    const size_t pixels = size_t(width) * height;
    if (mask.empty()) return pixels;
    if (mask.size() != pixels)
        throw Error("a mask of {} pixels doesn't fit an image of {} x {}", mask.size(), width, height);
    const size_t count = mask.size() - size_t(std::count(mask.begin(), mask.end(), uint8_t(0)));
    if (count == 0) throw Error("the mask selects no pixel of the image");
    return count;
}

double ErrorMap::meanUnder(PixelMask mask) const {
    return mask.empty() ? mean : meanValue(map, mask);
}

double meanRatio(const ImageF& test, const ImageF& reference, PixelMask mask) {
    checkPair(test, reference);
    const double testMean = meanValue(test, mask), referenceMean = meanValue(reference, mask);
    if (testMean == referenceMean) return 1;
    if (referenceMean == 0) return std::copysign(meanRatioCap, testMean);
    return std::clamp(testMean / referenceMean, -meanRatioCap, meanRatioCap);
}

double relMse(const ImageF& test, const ImageF& reference, PixelMask mask) {
    checkPair(test, reference);
    const double scale = unitScale(meanValue(reference, mask));
    return meanOf(test, reference, mask, [scale](double x, double r) {
        const double difference = (x - r) * scale, base = r * scale;
        return difference * difference / (base * base + relMseOffset);
    });
}

double nRmse(const ImageF& test, const ImageF& reference, PixelMask mask) {
    checkPair(test, reference);
    const double scale = unitScale(meanValue(reference, mask));
    return std::sqrt(meanOf(test, reference, mask, [scale](double x, double r) {
        const double difference = (x - r) * scale;
        return difference * difference;
    }));
}

double psnr(const ImageF& testDisplay, const ImageF& referenceDisplay, PixelMask mask) {
    checkPair(testDisplay, referenceDisplay);
    const double meanSquare =
        meanOf(testDisplay, referenceDisplay, mask, [](double x, double r) { return (x - r) * (x - r); });
    return meanSquare > 0 ? std::min(-10 * std::log10(meanSquare), psnrCap) : psnrCap;
}

ImageF blackLike(const ImageF& reference) {
    return ImageF(reference.width, reference.height, reference.channels);
}

ImageF constantLike(const ImageF& reference) {
    // Mean of each channel.
    std::vector<double> mean(reference.channels);
    for (size_t i = 0; i < reference.data.size(); ++i) mean[i % reference.channels] += double(reference.data[i]);
    for (double& value : mean) value /= double(reference.pixelCount());

    // The same everywhere.
    ImageF constant = blackLike(reference);
    for (size_t i = 0; i < constant.data.size(); ++i) constant.data[i] = float(mean[i % reference.channels]);
    return constant;
}

}  // namespace voxray
