#include "image/score.h"

#include "image/plane.h"

namespace voxray {
namespace {

constexpr Metric kMetrics[] = {
    {{"nrmse", "nRMSE", "", Better::Lower,
      "root of the mean squared error, in units of the reference's mean; weighs bright places"},
     [](const Comparison& c, PixelMask mask) { return nRmse(c.test, c.reference, mask); }},
    {{"relmse", "relMSE", "", Better::Lower,
      "mean of squared error over (reference² + 0.01), in units of the reference's mean; weighs dark places, "
      "leaks among them"},
     [](const Comparison& c, PixelMask mask) { return relMse(c.test, c.reference, mask); }},
    {{"flip", "HDR-FLIP", "", Better::Lower,
      "what an eye sees when flipping between the images, over a range of exposures; 0 to 1"},
     [](const Comparison& c, PixelMask mask) { return c.flip.meanUnder(mask); }},
    {{"flip_ldr", "LDR-FLIP", "", Better::Lower,
      "what an eye sees when flipping between the previews; 0 to 1"},
     [](const Comparison& c, PixelMask mask) { return c.flipLdr.meanUnder(mask); }},
    {{"ssim", "SSIM", "", Better::Higher, "structural similarity of the previews' luma; at most 1"},
     [](const Comparison& c, PixelMask mask) { return ssim(c.testDisplay, c.referenceDisplay, mask); }},
    {{"psnr_db", "PSNR", "dB", Better::Higher, "peak signal-to-noise ratio of the previews, peak 1"},
     [](const Comparison& c, PixelMask mask) { return psnr(c.testDisplay, c.referenceDisplay, mask); }},
    {{"mean_ratio", "mean ratio", "", Better::CloserToOne,
      "mean of the image over mean of the reference; 1 keeps the energy"},
     [](const Comparison& c, PixelMask mask) { return meanRatio(c.test, c.reference, mask); }},
};

}  // namespace

Comparison::Comparison(const ImageF& testImage, const ImageF& referenceImage, const ScoreOptions& options)
    : test(testImage), reference(referenceImage) {
    checkPair(test, reference);
    testDisplay = preview(test, options.exposureStops);
    referenceDisplay = preview(reference, options.exposureStops);
    flip = flipHdr(test, reference, options.flipExposures);
    flipLdr = voxray::flipLdr(testDisplay, referenceDisplay);
}

const char* nameOf(Better better) {
    return better == Better::Lower ? "low" : better == Better::Higher ? "high" : "one";
}

std::span<const Metric> metrics() {
    return kMetrics;
}

Scores score(const Comparison& comparison, PixelMask mask) {
    Scores scores;
    for (const Metric& metric : kMetrics) scores[metric.name] = metric.evaluate(comparison, mask);
    return scores;
}

}  // namespace voxray
