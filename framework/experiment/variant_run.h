#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "experiment/aovs.h"
#include "experiment/scoring.h"

namespace voxray {

/// The images of a variant: those of frame 0, and of later frames if they are compared.
struct VariantImages {
    ImageF final;
    std::optional<ImageF> indirect;
    std::optional<ImageF> flip, indirectFlip;  ///< 1 channel; only with a reference.
    std::vector<AovImage> aovs;
    std::vector<FrameImages> laterFrames;
};

/// The images of a graph's last frame. @throws Error if no pass wrote the compared one.
FrameImages downloadFrame(const Graph& graph, uint32_t number, Session& session);

/// Number of runs of a variant's graph, for estimates of cost.
uint64_t graphRuns(const Experiment& experiment);

/// Plans, prepares, runs, measures and scores a variant. Moves out its graph and sets its result.
/// @param reference of frame 0; nullptr: no scores. @param referenceOf returns the references of other
/// frames; empty: all frames share one. @param withAovs whether AOVs of frame 0 are downloaded.
/// @throws Error, Interrupted; validation messages are errors.
VariantImages renderVariant(Variant& variant, const Study& study, Session& session, const PreparedReference* reference,
                            const std::function<FrameReference(uint32_t)>& referenceOf, bool withAovs,
                            const std::function<void(double)>& progress);

/// Writes final, indirect and the FLIP maps as EXR and PNG into a folder, AOVs as EXR, and previews of all
/// compared frames of a sequence into its folder `frames`.
void writeVariantImages(const std::filesystem::path& folder, const VariantImages& images,
                        const ImageSettings& settings);
/// Writes a reference's images, their halves and its masks.
void writeReferenceImages(const std::filesystem::path& folder, const PreparedReference& reference,
                          const ImageSettings& settings);

/// The pixels that a mask selects, in white.
ImageF maskPicture(const PixelSelection& mask, uint32_t width, uint32_t height);

}  // namespace voxray
