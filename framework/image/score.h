#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "image/metrics.h"
#include "image/unbiased.h"

/// The metrics by which images are scored, in one table (score.cpp): results, `compare`, the manifest and the
/// report take names, directions and meanings from it.
namespace voxray {

struct ScoreOptions {
    float exposureStops = 0;      ///< Of the previews.
    FlipExposures flipExposures;  ///< Pinned, so that results can be compared between runs.
};

/// An image next to its reference, with what several metrics need of both.
struct Comparison {
    /// Images must outlive it. @param referenceHalves whose mean the reference is, where they are known.
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

/// Which values of a metric are better.
enum class Better { Lower, Higher, CloserToOne };
/// "low", "high" or "one".
const char* nameOf(Better better);

/// What results say of a number that tells how good an image is.
struct MetricInfo {
    const char* name;   ///< Column of results, key in JSON and word in `measure.metrics`.
    const char* label;  ///< For tables and charts.
    const char* unit;   ///< "" for none.
    Better better;
    const char* meaning;  ///< One sentence.
    /// Whether it is freed of the reference's noise and has a confidence interval, where the reference's
    /// halves are known.
    bool hasInterval;
};
/// What the names of an interval's ends add to a metric's.
inline constexpr const char* kLow = "_low";
inline constexpr const char* kHigh = "_high";

struct Metric : MetricInfo {
    Estimate (*evaluate)(const Comparison& comparison, PixelMask mask);
    /// Whether the reference's noise puts a floor under it: what a perfect image scores.
    bool hasNoiseFloor() const { return !hasInterval && better != Better::CloserToOne; }
};

/// All metrics. Tables list them in this order; the first three are charted against time and named in the
/// report's summary.
std::span<const Metric> metrics();

/// Values by metric, or by the column that a metric of one light and one mask has.
using Scores = std::map<std::string, double, std::less<>>;

/// Adds a score and the ends of its interval.
void addScore(Scores& scores, const std::string& name, const Estimate& estimate);
/// All metrics of the pixels under a mask, with the intervals that they have. @throws Error as the metrics.
Scores score(const Comparison& comparison, PixelMask mask = {});

/// What a perfect image is expected to score, for metrics with hasNoiseFloor(). It differs from the reference
/// by the reference's noise, and so do its halves, which make noise of the same variance: the mean of their
/// scores.
/// @param a, b the halves, each compared with their mean.
Scores noiseFloors(const Comparison& a, const Comparison& b, PixelMask mask = {});

}  // namespace voxray
