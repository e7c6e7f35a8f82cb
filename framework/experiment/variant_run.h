#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "experiment/manifest.h"
#include "experiment/session.h"

namespace voxray {

/// A reference with what every score against it needs.
struct PreparedReference {
    ReferenceImages images;
    ReferenceRecord record;
};
/// Pins the exposures and scores the black and the constant image.
PreparedReference prepareReference(ReferenceImages images, const ImageSettings& image,
                                   const std::string& folder);

/// One rendered variant: its row and its pictures.
struct RenderedVariant {
    VariantResult result;
    ImageF final;
    std::optional<ImageF> indirect;
    std::optional<ImageF> flip, indirectFlip;  ///< 1 channel, where there is a reference.
};

/// Plans, prepares, runs, measures and scores a variant; takes its graph. @param reference nullptr: no
/// scores.
/// @throws Error, Interrupted; validation messages are errors.
RenderedVariant renderVariant(WiredVariant& variant, const Experiment& experiment, Session& session,
                              const PreparedReference* reference,
                              const std::function<void(double)>& progress);

/// Writes final, indirect and the FLIP maps as EXR and PNG into a folder.
void writeVariantImages(const std::filesystem::path& folder, const RenderedVariant& variant,
                        float exposureStops);
void writeReferenceImages(const std::filesystem::path& folder, const ReferenceImages& images,
                          float exposureStops);

}  // namespace voxray
