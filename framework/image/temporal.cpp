#include "image/temporal.h"

#include <cmath>
#include <numeric>

#include "base/error.h"
#include "image/plane.h"

namespace voxray {
namespace {

constexpr MetricInfo kTemporalMetrics[] = {
    {"temporal_nrmse", "temporal nRMSE", "", Better::Lower,
     "root of the mean squared difference of successive frames' errors, in units of the reference's mean"},
    {"temporal_bias", "temporal bias", "", Better::Lower,
     "the part of it that is the same from each frame to the next: error that builds up, as lag does"},
    {"temporal_flicker", "flicker", "", Better::Lower,
     "the part of it that varies from frame to frame: noise and popping"},
};

double meanOf(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace

std::span<const MetricInfo> temporalMetrics() {
    return kTemporalMetrics;
}

void TemporalError::add(const ImageF& test, const ImageF& reference, double referenceVariance) {
    checkPair(test, reference);
    const size_t count = test.data.size();
    const bool isFirst = variances_.empty();
    if (isFirst) {
        error_.resize(count);
        mean_.resize(count);
        squaredSpread_.resize(count);
    } else if (error_.size() != count) {
        throw Error("a frame of {} values follows frames of {}", count, error_.size());
    }
    const double steps = double(variances_.size());  // That d_t counts with this frame.
    double squares = 0, radiance = 0;
    for (size_t i = 0; i < count; ++i) {
        const double error = double(test.data[i]) - double(reference.data[i]);
        radiance += double(reference.data[i]);
        const double d = error - error_[i];
        error_[i] = error;
        if (isFirst) continue;

        // Mean and spread so far (Welford 1962)
        const double fromOldMean = d - mean_[i];
        mean_[i] += fromOldMean / steps;
        squaredSpread_[i] += fromOldMean * (d - mean_[i]);
        squares += d * d;
    }
    if (!isFirst) meanSquares_.push_back(squares / double(count));
    variances_.push_back(referenceVariance);
    referenceMeans_ += radiance / double(count);
}

double TemporalError::scale() const {
    const double mean = referenceMeans_ / double(variances_.size());
    return mean > 0 ? 1 / mean : 1;
}

Scores TemporalError::scores() const {
    if (meanSquares_.empty()) return {};
    const double steps = double(meanSquares_.size());
    double bias = 0;
    for (const double mean : mean_) bias += mean * mean;
    const double flicker = meanOf(squaredSpread_) / steps;

    // The difference of two independent references has the sum of their variances
    double noise = 0;
    for (size_t t = 1; t < variances_.size(); ++t) noise += variances_[t] + variances_[t - 1];
    return {{"temporal_nrmse", scale() * std::sqrt(meanOf(meanSquares_))},
            {"temporal_bias", scale() * std::sqrt(bias / double(mean_.size()))},
            {"temporal_flicker", scale() * std::sqrt(flicker)},
            {kTemporalNoise, scale() * std::sqrt(noise / steps)}};
}

std::vector<double> TemporalError::frameErrors() const {
    std::vector<double> errors;
    for (const double square : meanSquares_) errors.push_back(scale() * std::sqrt(square));
    return errors;
}

}  // namespace voxray
