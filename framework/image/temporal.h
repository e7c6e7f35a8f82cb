#pragma once

#include <span>
#include <vector>

#include "image/score.h"

/// Temporal error of a sequence of frames: change from frame to frame that the reference doesn't have.
///
/// With e_t = x_t - r_t, the error of frame t, the temporal error is the difference
///   d_t = (x_t - x_{t-1}) - (r_t - r_{t-1}) = e_t - e_{t-1},  t = 1 ... T.
/// With the mean m of d_t over t of each value of each pixel, mean(d_t²) = m² + mean((d_t - m)²): bias and
/// flicker. The bias telescopes, m = (e_T - e_0) / T: constant and alternating errors have (nearly) none.
/// Squares are products of the errors against the two halves of the reference (unbiased.h), so that its noise
/// doesn't contribute.
namespace voxray {

/// temporal_nrmse, temporal_bias and temporal_flicker: their root mean squares over pixels and frames, in
/// units of the reference's mean over all frames. The square of the first is the sum of the squares of the
/// others, unless one is clamped to 0.
std::span<const MetricInfo> temporalMetrics();

/// Accumulates a sequence frame by frame; keeps five numbers per value of the image.
class TemporalError {
 public:
    /// @throws Error if the images differ in size from each other or from earlier frames, or aren't finite.
    void add(const ImageF& test, const ReferenceHalves& reference);

    /// Scores of temporalMetrics(), with their intervals. Empty before the second frame.
    Scores scores() const;
    /// temporal_nrmse of each frame after the first one, t = 1 ... T.
    std::vector<double> frameErrors() const;

 private:
    /// State of one value, against the halves a and b.
    struct Value {
        double errorA = 0, errorB = 0;  ///< e_t of the last frame.
        double meanA = 0, meanB = 0;    ///< Means of d_t.
        double spread = 0;              ///< Sum of the products of (d_t - mean) against a and against b.
    };
    double scale() const;

    uint32_t width_ = 0, height_ = 0;
    std::vector<Value> values_;
    std::vector<double> meanSquares_;  ///< Mean of d_t² over the image, by t.
    size_t frames_ = 0;
    double referenceMeans_ = 0;  ///< Sum over frames.
};

}  // namespace voxray
