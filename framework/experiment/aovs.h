#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "graph/graph.h"
#include "image/image.h"

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

/// Writes aovs.<pass>.exr of each into a folder.
void writeAovs(const std::filesystem::path& folder, const std::vector<AovImage>& aovs);

}  // namespace voxray
