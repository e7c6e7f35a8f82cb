#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "experiment/aovs.h"
#include "experiment/scoring.h"

namespace voxray {

/// One rendered variant: its row, the pictures of frame 0, and those of later frames where they are compared.
struct RenderedVariant {
    VariantResult result;
    ImageF final;
    std::optional<ImageF> indirect;
    std::optional<ImageF> flip, indirectFlip;  ///< 1 channel, where there is a reference.
    std::vector<AovImage> aovs;
    std::vector<FrameImages> laterFrames;
};

/// How often the graph of a variant runs until it is measured.
uint64_t graphRuns(const Experiment& experiment);

/// Plans, prepares, runs, measures and scores a variant; takes its graph.
/// @param reference of frame 0; nullptr: no scores. @param referenceOf the references of other frames, where
/// frames are compared and not all show the same. @param registry for the graph of its second seed. @param
/// withAovs whether AOVs of frame 0 are read back.
/// @throws Error, Interrupted; validation messages are errors.
RenderedVariant renderVariant(WiredVariant& variant, const Experiment& experiment, Session& session,
                              const PreparedReference* reference,
                              const std::function<FrameReference(uint32_t)>& referenceOf,
                              const Registry& registry, bool withAovs,
                              const std::function<void(double)>& progress);

/// Writes final, indirect and the FLIP maps as EXR and PNG into a folder, AOVs as EXR. Of a sequence,
/// previews of all compared frames go into its folder `frames`.
void writeVariantImages(const std::filesystem::path& folder, const RenderedVariant& variant,
                        float exposureStops);
/// Writes a reference's images, their halves and its masks.
void writeReferenceImages(const std::filesystem::path& folder, const PreparedReference& reference,
                          float exposureStops);

}  // namespace voxray
