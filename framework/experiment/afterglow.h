#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "experiment/results.h"

/// How long a light that is switched off (`off_at`) stays in the picture.
namespace voxray {

/// Fraction of a light that an eye sees: Weber's fraction of brightness.
inline constexpr double kVisibleFraction = 0.02;

/// Mean radiance of a compared frame and of its reference.
struct FrameMeans {
    double test = 0;
    double reference = 0;
};

/// Scores of a compared frame from `offAt` on: `afterglow`, by how much the frame is brighter than its
/// reference, over what the reference lost when the light went off (below 0: darker); `frames_lit`, in how
/// many of the compared frames so far that was over kVisibleFraction.
/// @param light what columns begin with. @param means of `frames`, in their order, as they are compared. No
/// score where no frame before is compared, or the reference did not lose light.
void scoreAfterglow(std::span<const FrameMeans> means, uint32_t offAt, const std::string& light,
                    std::span<FrameScores> frames);

}  // namespace voxray
