#pragma once

#include <span>
#include <vector>

#include "image/score.h"

/// Temporal error of a sequence of frames: what of the change from frame to frame is not the reference's own.
///
/// With e_t = x_t - r_t, the error of frame t, the temporal error is the difference
///   d_t = (x_t - x_{t-1}) - (r_t - r_{t-1}) = e_t - e_{t-1},  t = 1 ... T.
/// For each value of each pixel, m is the mean of d_t over t, and d_t = m + (d_t - m) splits without a cross
/// term: mean(d_t²) = m² + mean((d_t - m)²). The first part is the bias, the second the flicker. The bias
/// telescopes, m = (e_T - e_0) / T: an error that stays, and one that only alternates, has (nearly) none.
/// Each square is the product of what the two halves of the reference give (unbiased.h), so that noise of the
/// reference adds nothing.
namespace voxray {

/// temporal_nrmse, temporal_bias and temporal_flicker: their root mean squares over pixels and frames, in
/// units of the reference's mean over all frames. The first squared is the sum of the others squared, where
/// none of them is below 0.
std::span<const MetricInfo> temporalMetrics();

/// Collects a sequence frame by frame; keeps five numbers a value of the image.
class TemporalError {
 public:
    /// @throws Error where the images differ in size from each other or from earlier frames, or aren't
    /// finite.
    void add(const ImageF& test, const ReferenceHalves& reference);

    /// Of temporalMetrics(), with their intervals. Empty before the second frame.
    Scores scores() const;
    /// temporal_nrmse of each frame after the first one, t = 1 ... T.
    std::vector<double> frameErrors() const;

 private:
    /// Of one value, against the halves a and b.
    struct Value {
        double errorA = 0, errorB = 0;  ///< e_t of the last frame.
        double meanA = 0, meanB = 0;    ///< Of d_t.
        double spread = 0;              ///< Sum of the products of (d_t - mean) against a and against b.
    };
    double scale() const;

    uint32_t width_ = 0, height_ = 0;
    std::vector<Value> values_;
    std::vector<double> meanSquares_;  ///< Of d_t over the image, a number a t.
    size_t frames_ = 0;
    double referenceMeans_ = 0;  ///< Sum over frames.
};

}  // namespace voxray
