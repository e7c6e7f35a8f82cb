#include "image/seed_error.h"

#include "image/plane.h"

namespace voxray {
namespace {

constexpr MetricInfo kSeedMetrics[] = {
    {"bias_nrmse", "bias", "", Better::Lower,
     "the part of nRMSE that stays when random numbers change: "
     "more rays lower it only where a filter blurs less with them",
     true},
    {"noise_nrmse", "noise", "", Better::Lower,
     "the part of nRMSE that changes with random numbers: more rays or a filter lower it", true},
};

}  // namespace

std::span<const MetricInfo> seedMetrics() {
    return kSeedMetrics;
}

Scores seedScores(const ImageF& first, const ImageF& second, const ReferenceHalves& reference, PixelMask mask) {
    for (const ImageF* image : {&second, &reference.a, &reference.b}) checkPair(first, *image);
    const double mean = 0.5 * (meanValue(reference.a, mask) + meanValue(reference.b, mask));
    std::vector<double> bias(first.pixelCount()), noise(first.pixelCount());
    for (size_t i = 0; i < first.data.size(); ++i) {
        const double x = first.data[i], y = second.data[i], a = reference.a.data[i], b = reference.b.data[i];
        bias[i / 3] += ((x - a) * (y - b) + (x - b) * (y - a)) / 6;
        noise[i / 3] += (x - y) * (x - y) / 6;
    }
    Scores scores;
    const auto addRoot = [&](const MetricInfo& metric, const std::vector<double>& squares) {
        addScore(scores, metric.name, rootOf(meanOverTiles(squares, first.width, first.height, mask), unitScale(mean)));
    };
    addRoot(kSeedMetrics[0], bias);
    addRoot(kSeedMetrics[1], noise);
    return scores;
}

}  // namespace voxray
