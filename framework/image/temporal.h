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
namespace voxray {

/// temporal_nrmse, temporal_bias and temporal_flicker: their root mean squares over pixels and frames, in
/// units of the reference's mean over all frames. The first squared is the sum of the others squared.
std::span<const MetricInfo> temporalMetrics();
/// What stands next to them: the part of temporal_nrmse that the noise of the reference alone adds.
inline constexpr const char* kTemporalNoise = "temporal_noise";

/// Collects a sequence frame by frame; keeps three numbers a value of the image.
class TemporalError {
 public:
    /// @param referenceVariance mean variance of the reference's values: its noise in this frame. 0 where all
    /// frames have one and the same reference image, whose noise cancels in differences.
    /// @throws Error where the images differ in size from each other or from earlier frames, or aren't
    /// finite.
    void add(const ImageF& test, const ImageF& reference, double referenceVariance);

    /// Of temporalMetrics(), and kTemporalNoise for frames with independent references: squares add. Empty
    /// before the second frame.
    Scores scores() const;
    /// temporal_nrmse of each frame after the first one, t = 1 ... T.
    std::vector<double> frameErrors() const;

 private:
    double scale() const;

    std::vector<double> error_;                 ///< e_t of the last frame.
    std::vector<double> mean_, squaredSpread_;  ///< Of d_t: mean, and sum of (d_t - mean)².
    std::vector<double> meanSquares_;           ///< Of d_t over the image, a number a t.
    std::vector<double> variances_;             ///< Of the reference, a number a frame.
    double referenceMeans_ = 0;                 ///< Sum over frames.
};

}  // namespace voxray
