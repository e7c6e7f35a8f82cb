#pragma once

#include <functional>
#include <map>
#include <span>
#include <string>

#include "image/metrics.h"

/// The metrics by which images are scored, in one table (score.cpp): results, `compare`, the manifest and the
/// report take names, directions and meanings from it.
namespace voxray {

struct ScoreOptions {
    float exposureStops = 0;      ///< Of the previews.
    FlipExposures flipExposures;  ///< Pinned, so that results can be compared between runs.
};

/// An image next to its reference, with what several metrics need of both.
struct Comparison {
    /// Both images must outlive it. @throws Error as the metrics (metrics.h).
    Comparison(const ImageF& testImage, const ImageF& referenceImage, const ScoreOptions& options);
    const ImageF& test;
    const ImageF& reference;
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
};

struct Metric : MetricInfo {
    double (*evaluate)(const Comparison& comparison, PixelMask mask);
};

/// All metrics. Tables list them in this order; the first three are charted against time and named in the
/// report's summary.
std::span<const Metric> metrics();

/// Values by metric, or by the column that a metric of one light and one mask has.
using Scores = std::map<std::string, double, std::less<>>;

/// All metrics of the pixels under a mask. @throws Error as the metrics.
Scores score(const Comparison& comparison, PixelMask mask = {});

}  // namespace voxray
