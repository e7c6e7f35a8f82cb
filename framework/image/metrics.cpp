#include "image/metrics.h"

#include <algorithm>
#include <cmath>

#include "image/plane.h"

namespace voxray {

namespace {

// Mean of f(test value, reference value) over all values.
template <typename F>
double meanOf(const ImageF& test, const ImageF& reference, const F& f) {
    const size_t rowValues = size_t(reference.width) * reference.channels;
    const double sum = sumRows(reference.height, [&](size_t y) {
        const float* x = &test.data[y * rowValues];
        const float* r = &reference.data[y * rowValues];
        double rowSum = 0;
        for (size_t i = 0; i < rowValues; ++i) rowSum += f(double(x[i]), double(r[i]));
        return rowSum;
    });
    return sum / double(reference.data.size());
}

double meanOf(const ImageF& image) {
    return meanOf(image, image, [](double x, double) { return x; });
}

// What both images are multiplied by, so that neither exposure nor light strength changes a score.
double scaleOf(const ImageF& reference) {
    const double mean = meanOf(reference);
    return mean > 0 ? 1 / mean : 1;
}

}  // namespace

double meanRatio(const ImageF& test, const ImageF& reference) {
    checkPair(test, reference);
    const double testMean = meanOf(test), referenceMean = meanOf(reference);
    if (testMean == referenceMean) return 1;
    if (referenceMean == 0) return std::copysign(meanRatioCap, testMean);
    return std::clamp(testMean / referenceMean, -meanRatioCap, meanRatioCap);
}

double relMse(const ImageF& test, const ImageF& reference) {
    checkPair(test, reference);
    const double scale = scaleOf(reference);
    return meanOf(test, reference, [scale](double x, double r) {
        const double difference = (x - r) * scale, base = r * scale;
        return difference * difference / (base * base + 0.01);
    });
}

double nRmse(const ImageF& test, const ImageF& reference) {
    checkPair(test, reference);
    const double scale = scaleOf(reference);
    return std::sqrt(meanOf(test, reference, [scale](double x, double r) {
        const double difference = (x - r) * scale;
        return difference * difference;
    }));
}

double psnr(const ImageF& testDisplay, const ImageF& referenceDisplay) {
    checkPair(testDisplay, referenceDisplay);
    const double meanSquare =
        meanOf(testDisplay, referenceDisplay, [](double x, double r) { return (x - r) * (x - r); });
    return meanSquare > 0 ? std::min(-10 * std::log10(meanSquare), psnrCap) : psnrCap;
}

Scores score(const ImageF& test, const ImageF& reference, const ScoreOptions& options, ImageF* flipMap) {
    checkPair(test, reference);
    Scores scores;

    // What an eye sees: display images at the fixed exposure, and all exposures at once.
    const ImageF testDisplay = preview(test, options.exposureStops);
    const ImageF referenceDisplay = preview(reference, options.exposureStops);
    scores.flipLdr = flipLdr(testDisplay, referenceDisplay).mean;
    scores.ssim = ssim(testDisplay, referenceDisplay);
    scores.psnrDb = psnr(testDisplay, referenceDisplay);
    ErrorMap flip = flipHdr(test, reference, options.flipExposures);
    scores.flip = flip.mean;
    if (flipMap) *flipMap = std::move(flip.map);

    // What a meter sees: linear values.
    scores.nrmse = nRmse(test, reference);
    scores.relmse = relMse(test, reference);
    scores.meanRatio = meanRatio(test, reference);
    return scores;
}

ImageF blackLike(const ImageF& reference) {
    return ImageF(reference.width, reference.height, reference.channels);
}

ImageF constantLike(const ImageF& reference) {
    // Mean of each channel.
    std::vector<double> mean(reference.channels);
    for (size_t i = 0; i < reference.data.size(); ++i)
        mean[i % reference.channels] += double(reference.data[i]);
    for (double& value : mean) value /= double(reference.pixelCount());

    // The same everywhere.
    ImageF constant = blackLike(reference);
    for (size_t i = 0; i < constant.data.size(); ++i) constant.data[i] = float(mean[i % reference.channels]);
    return constant;
}

}  // namespace voxray
