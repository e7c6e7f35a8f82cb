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

/// A reference with masks, exposures and noise floors for scores against it.
struct PreparedReference {
    ReferenceImages images;
    std::vector<PixelSelection> masks;
    ReferenceRecord record;
};
/// Computes exposures, and noise floors for all masks. @throws Interrupted.
PreparedReference prepareReference(ReferenceImages images, std::vector<PixelSelection> masks,
                                   const ImageSettings& image, const std::string& folder);
/// Computes the scores of a black and a constant image for all masks. @throws Interrupted.
void addBaselines(PreparedReference& reference, const ImageSettings& image);

/// The images of a variant in one of its measured frames.
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
/// Scores both lights on the whole image and under each mask that selects a pixel. @throws Interrupted.
/// @param pinned has the exposures: those of frame 0 are used for all frames.
ScoredFrame scoreFrame(const FrameImages& test, const ReferenceImages& reference,
                       const std::vector<PixelSelection>& masks, const ReferenceRecord& pinned, float exposureStops);

/// Splits the error of frame 0 into bias and noise, for total and indirect light, and stores them in
/// `scores`.
/// @param first, second the frame with two seeds.
void scoreSeeds(const FrameImages& first, const FrameImages& second, const ReferenceImages& reference, Scores& scores);

/// The reference of a measured frame and the pixels that masks select there.
struct FrameReference {
    ReferenceImages images;
    std::vector<PixelSelection> masks;
};

/// Smallest relative difference of brightness that is visible: Weber's fraction.
inline constexpr double kVisibleFraction = 0.02;

/// Mean radiance of a compared frame and of its reference.
struct FrameMeans {
    double test = 0;
    double reference = 0;
};

/// Scores compared frames from `offAt` on, in which a light was switched off: `afterglow` is the excess
/// brightness of the frame over its reference, relative to the loss of the reference when the light was
/// switched off (below 0: too dark); `frames_lit` is the number of compared frames so far with an afterglow
/// over kVisibleFraction. There are no scores if no frame before was compared or the reference did not become
/// darker.
/// @param light prefix of columns. @param means of `frames`, in the same order.
void scoreAfterglow(std::span<const FrameMeans> means, uint32_t offAt, const std::string& light,
                    std::span<FrameScores> frames);

/// Stores the scores of each compared frame in `result.frames` and the temporal error of all of them in
/// `result.scores`.
/// @param first the scores of frame 0. @param referenceOf returns the reference of another frame; empty: all
/// frames share the prepared one. @param lightOff the frame in which a light is switched off, if any.
void scoreSequence(const std::vector<FrameImages>& frames, const PreparedReference& reference, const Scores& first,
                   const std::function<FrameReference(uint32_t)>& referenceOf, float exposureStops,
                   std::optional<uint32_t> lightOff, VariantResult& result);

}  // namespace voxray
