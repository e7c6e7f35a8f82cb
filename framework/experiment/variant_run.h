#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "experiment/scoring.h"

namespace voxray {

/// The AOVs of one resource of a variant, channel by channel.
struct AovImage {
    std::string pass;  ///< Id of the pass that wrote the resource.
    ImageF image;
    std::vector<std::string> channels;
};

/// Reads back what the graph's resources offer to look at (Resource::aovs). Of each image's own size, three
/// channels follow that the host finds by camera rays: Z, the distance along the camera's axis in m (+inf
/// where no surface is), and `id` and `material_id`, the numbers of the mesh instance and the material in the
/// scene's order (-1 for none).
/// @param origin where the frame's coordinates count from; those of the layer P count from the world's.
/// @throws Error where a resource's AOVs differ in size or are of another format.
std::vector<AovImage> downloadAovs(const Graph& graph, const Frame& frame, const glm::vec3& origin,
                                   Device& device, CommandStream& stream);

/// What a variant rendered: pictures of frame 0, and those of later frames where they are compared.
struct VariantImages {
    ImageF final;
    std::optional<ImageF> indirect;
    std::optional<ImageF> flip, indirectFlip;  ///< 1 channel, where there is a reference.
    std::vector<AovImage> aovs;
    std::vector<FrameImages> laterFrames;
};

/// How often the graph of a variant runs until it is measured.
uint64_t graphRuns(const Experiment& experiment);

/// Plans, prepares, runs, measures and scores a variant; takes its graph and fills in its result.
/// @param reference of frame 0; nullptr: no scores. @param referenceOf the references of other frames, where
/// frames are compared and not all show the same. @param withAovs whether AOVs of frame 0 are read back.
/// @throws Error, Interrupted; validation messages are errors.
VariantImages renderVariant(Variant& variant, const Study& study, Session& session,
                            const PreparedReference* reference,
                            const std::function<FrameReference(uint32_t)>& referenceOf, bool withAovs,
                            const std::function<void(double)>& progress);

/// Writes final, indirect and the FLIP maps as EXR and PNG into a folder, AOVs as EXR. Of a sequence,
/// previews of all compared frames go into its folder `frames`.
void writeVariantImages(const std::filesystem::path& folder, const VariantImages& images,
                        float exposureStops);
/// Writes a reference's images, their halves and its masks.
void writeReferenceImages(const std::filesystem::path& folder, const PreparedReference& reference,
                          float exposureStops);

}  // namespace voxray
