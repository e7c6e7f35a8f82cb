#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiment/manifest.h"
#include "experiment/results.h"
#include "experiment/session.h"

namespace voxray {

/// A reference with what every score against it needs.
struct PreparedReference {
    ReferenceImages images;
    std::vector<PixelSelection> masks;
    ReferenceRecord record;
};
/// Pins the exposures, scores the black and the constant image and finds the noise floors, on the whole image
/// and under each mask.
PreparedReference prepareReference(ReferenceImages images, std::vector<PixelSelection> masks,
                                   const ImageSettings& image, const std::string& folder);

/// What a variant rendered in one of its measured frames.
struct FrameImages {
    uint32_t frame = 0;
    ImageF final;
    std::optional<ImageF> indirect;
};

/// The scores of a frame by column, and its HDR-FLIP maps (1 channel).
struct ScoredFrame {
    Scores scores;
    ImageF flip;
    std::optional<ImageF> indirectFlip;
};
/// Scores both lights on the whole image and under each mask that selects a pixel.
/// @param pinned whose exposures are taken: those of frame 0 for all frames.
ScoredFrame scoreFrame(const FrameImages& test, const ReferenceImages& reference,
                       const std::vector<PixelSelection>& masks, const ReferenceRecord& pinned,
                       float exposureStops);

/// Scores what of the error in frame 0 is bias and what noise into `scores`, of both lights.
/// @param first, second the frame with two seeds.
void scoreSeeds(const FrameImages& first, const FrameImages& second, const ReferenceImages& reference,
                Scores& scores);

/// The reference of a measured frame and the pixels that masks select there.
struct FrameReference {
    ReferenceImages images;
    std::vector<PixelSelection> masks;
};

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

/// Scores each compared frame into `result.frames` and the temporal error of all of them into
/// `result.scores`.
/// @param first the scores of frame 0. @param referenceOf the reference of another frame; empty: all frames
/// share the prepared one. @param lightOff the frame in which a light is switched off, if any.
void scoreSequence(const std::vector<FrameImages>& frames, const PreparedReference& reference,
                   const Scores& first, const std::function<FrameReference(uint32_t)>& referenceOf,
                   float exposureStops, std::optional<uint32_t> lightOff, VariantResult& result);

}  // namespace voxray
