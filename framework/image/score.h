#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "image/metrics.h"
#include "image/unbiased.h"

/// Table of metrics (score.cpp). Results, `compare`, the manifest and the report take names, directions and
/// meanings from it.
namespace voxray {

struct ScoreOptions {
    float exposureStops = 0;      ///< Exposure of the previews.
    FlipExposures flipExposures;  ///< Fixed, so that results are comparable between runs.
};

/// An image and its reference, with intermediate results that several metrics share.
struct Comparison {
    /// Images must outlive it. @param referenceHalves whose mean is the reference, if known.
    /// @throws Error as the metrics (metrics.h).
    Comparison(const ImageF& testImage, const ImageF& referenceImage, const ScoreOptions& options,
               const std::optional<ReferenceHalves>& referenceHalves = {});
    const ImageF& test;
    const ImageF& reference;
    std::optional<ReferenceHalves> halves;
    ImageF testDisplay, referenceDisplay;  ///< Previews at the fixed exposure.
    ErrorMap flip;                         ///< HDR-FLIP.
    ErrorMap flipLdr;                      ///< LDR-FLIP of the previews.
};

/// Direction of a metric.
enum class Better { Lower, Higher, CloserToOne };
/// "low", "high" or "one".
const char* nameOf(Better better);

/// Description of a metric in results.
struct MetricInfo {
    const char* name;   ///< Column of results, key in JSON and word in `measure.metrics`.
    const char* label;  ///< For tables and charts.
    const char* unit;   ///< "" for none.
    Better better;
    const char* meaning;  ///< One sentence.
    /// Whether the reference's noise is removed and there is a confidence interval, given the reference's
    /// halves.
    bool hasInterval;
};
/// Suffixes of the ends of an interval.
inline constexpr const char* kLow = "_low";
inline constexpr const char* kHigh = "_high";
/// Suffix of a noise floor (noiseFloors()).
inline constexpr const char* kNoise = "_noise";

struct Metric : MetricInfo {
    Estimate (*evaluate)(const Comparison& comparison, PixelMask mask);
    /// Whether a perfect image has a nonzero error because of the reference's noise.
    bool hasNoiseFloor() const { return !hasInterval && better != Better::CloserToOne; }
};

/// All metrics, in the order of tables; the report charts the first three against time and names them in its
/// summary.
std::span<const Metric> metrics();

/// Values by metric, or by column of a metric with a light and a mask.
using Scores = std::map<std::string, double, std::less<>>;

/// Adds a score and the ends of its interval.
void addScore(Scores& scores, const std::string& name, const Estimate& estimate);
/// All metrics of the pixels under a mask, with their intervals. @throws Error as the metrics.
Scores score(const Comparison& comparison, PixelMask mask = {});

/// Expected scores of a perfect image, for metrics with hasNoiseFloor(). It differs from the reference by the
/// reference's noise. The halves differ from it by noise of the same variance, so the floor is the mean of
/// their scores. @param a, b the halves, each compared with their mean.
Scores noiseFloors(const Comparison& a, const Comparison& b, PixelMask mask = {});

}  // namespace voxray
