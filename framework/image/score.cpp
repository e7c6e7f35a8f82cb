#include "image/score.h"

#include "image/plane.h"

namespace voxray {
namespace {

constexpr Metric kMetrics[] = {
    {{"nrmse", "nRMSE", "", Better::Lower,
      "root of the mean squared error, in units of the reference's mean; weighs bright places", true},
     [](const Comparison& c, PixelMask mask) {
         return c.halves ? nRmse(c.test, *c.halves, mask) : Estimate(nRmse(c.test, c.reference, mask));
     }},
    {{"relmse", "relMSE", "", Better::Lower,
      "mean of squared error over (reference² + 0.01), in units of the reference's mean; "
      "weighs dark places, leaks among them",
      true},
     [](const Comparison& c, PixelMask mask) {
         return c.halves ? relMse(c.test, *c.halves, mask) : Estimate(relMse(c.test, c.reference, mask));
     }},
    {{"flip", "HDR-FLIP", "", Better::Lower,
      "what an eye sees when flipping between the images, over a range of exposures; 0 to 1", false},
     [](const Comparison& c, PixelMask mask) { return Estimate(c.flip.meanUnder(mask)); }},
    {{"flip_ldr", "LDR-FLIP", "", Better::Lower, "what an eye sees when flipping between the previews; 0 to 1", false},
     [](const Comparison& c, PixelMask mask) { return Estimate(c.flipLdr.meanUnder(mask)); }},
    {{"ssim", "SSIM", "", Better::Higher, "structural similarity of the previews' luma; at most 1", false},
     [](const Comparison& c, PixelMask mask) { return Estimate(ssim(c.testDisplay, c.referenceDisplay, mask)); }},
    {{"psnr_db", "PSNR", "dB", Better::Higher, "peak signal-to-noise ratio of the previews, peak 1", false},
     [](const Comparison& c, PixelMask mask) { return Estimate(psnr(c.testDisplay, c.referenceDisplay, mask)); }},
    {{"mean_ratio", "mean ratio", "", Better::CloserToOne,
      "mean of the image over mean of the reference; 1 keeps the energy", false},
     [](const Comparison& c, PixelMask mask) { return Estimate(meanRatio(c.test, c.reference, mask)); }},
};

}  // namespace

Comparison::Comparison(const ImageF& testImage, const ImageF& referenceImage, const ScoreOptions& options,
                       const std::optional<ReferenceHalves>& referenceHalves)
    : test(testImage), reference(referenceImage), halves(referenceHalves) {
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

void addScore(Scores& scores, const std::string& name, const Estimate& estimate) {
    scores[name] = estimate.value;
    if (!estimate.interval) return;
    scores[name + kLow] = estimate.interval->low;
    scores[name + kHigh] = estimate.interval->high;
}

Scores score(const Comparison& comparison, PixelMask mask) {
    Scores scores;
    for (const Metric& metric : kMetrics) addScore(scores, metric.name, metric.evaluate(comparison, mask));
    return scores;
}

Scores noiseFloors(const Comparison& a, const Comparison& b, PixelMask mask) {
    Scores floors;
    for (const Metric& metric : kMetrics)
        if (metric.hasNoiseFloor())
            floors[metric.name] = 0.5 * (metric.evaluate(a, mask).value + metric.evaluate(b, mask).value);
    return floors;
}

}  // namespace voxray
