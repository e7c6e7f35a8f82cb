#include "image/temporal.h"

#include "base/error.h"
#include "image/plane.h"

namespace voxray {
namespace {

constexpr MetricInfo kTemporalMetrics[] = {
    {"temporal_nrmse", "temporal nRMSE", "", Better::Lower,
     "root of the mean squared difference of successive frames' errors, in units of the reference's mean", true},
    {"temporal_bias", "temporal bias", "", Better::Lower,
     "the part of it that is the same from each frame to the next: error that builds up, as lag does", true},
    {"temporal_flicker", "flicker", "", Better::Lower,
     "the part of it that varies from frame to frame: noise and popping", true},
};

}  // namespace

std::span<const MetricInfo> temporalMetrics() {
    return kTemporalMetrics;
}

void TemporalError::add(const ImageF& test, const ReferenceHalves& reference) {
    checkPair(test, reference.a);
    checkPair(test, reference.b);
    const size_t count = test.data.size();
    if (frames_ == 0) {
        width_ = test.width;
        height_ = test.height;
        values_.resize(count);
    } else if (test.width != width_ || test.height != height_) {
        throw Error("a frame of {} x {} follows frames of {} x {}", test.width, test.height, width_, height_);
    }
    const double steps = double(frames_);  // Number of d_t including this frame.
    double squares = 0, radiance = 0;
    for (size_t i = 0; i < count; ++i) {
        Value& v = values_[i];
        const double x = test.data[i], a = reference.a.data[i], b = reference.b.data[i];
        radiance += 0.5 * (a + b);
        const double stepA = x - a - v.errorA, stepB = x - b - v.errorB;
        v.errorA = x - a;
        v.errorB = x - b;
        if (frames_ == 0) continue;

        // Running means and spread (Welford 1962)
        const double deviationA = stepA - v.meanA;
        v.meanA += deviationA / steps;
        v.meanB += (stepB - v.meanB) / steps;
        v.spread += deviationA * (stepB - v.meanB);
        squares += stepA * stepB;
    }
    if (frames_ > 0) meanSquares_.push_back(squares / double(count));
    ++frames_;
    referenceMeans_ += radiance / double(count);
}

double TemporalError::scale() const {
    return unitScale(referenceMeans_ / double(frames_));
}

Scores TemporalError::scores() const {
    if (meanSquares_.empty()) return {};
    std::vector<double> bias(values_.size() / 3), flicker(bias.size()), total(bias.size());
    for (size_t i = 0; i < values_.size(); ++i) {
        bias[i / 3] += values_[i].meanA * values_[i].meanB / 3;
        flicker[i / 3] += values_[i].spread / double(meanSquares_.size()) / 3;
    }
    for (size_t i = 0; i < total.size(); ++i) total[i] = bias[i] + flicker[i];
    Scores scores;
    const auto addRoot = [&](const char* name, const std::vector<double>& squares) {
        addScore(scores, name, rootOf(meanOverTiles(squares, width_, height_, {}), scale()));
    };
    addRoot("temporal_nrmse", total);
    addRoot("temporal_bias", bias);
    addRoot("temporal_flicker", flicker);
    return scores;
}

std::vector<double> TemporalError::frameErrors() const {
    std::vector<double> errors;
    for (const double square : meanSquares_) errors.push_back(rootOf(square, scale()).value);
    return errors;
}

}  // namespace voxray
