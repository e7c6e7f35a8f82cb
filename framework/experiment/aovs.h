#pragma once

#include <string>
#include <vector>

#include "graph/graph.h"
#include "image/image.h"

namespace voxray {

/// The AOVs of one resource of a variant as channels of an image.
struct AovImage {
    std::string pass;  ///< Id of the pass that wrote the resource.
    ImageF image;
    std::vector<std::string> channels;
};

/// Downloads the AOVs of the graph's resources (Resource::aovs). Each image has the channels kHitChannels, too.
/// @param origin of the frame's coordinates; it is added to the layer P.
/// @throws Error if a resource's AOVs differ in size or have another format.
std::vector<AovImage> downloadAovs(const Graph& graph, const Frame& frame, const glm::vec3& origin, Device& device,
                                   CommandStream& stream);

/// Channels that are computed with camera rays on the host: Z, the distance along the camera's axis in m (+inf without
/// a surface), and the indices of the mesh instance and the material in the scene (-1 for none).
inline constexpr const char* kHitChannels[] = {"Z", "id", "material_id"};
/// One of them alone, as downloadAovs() has it.
ImageF hitChannel(const std::string& name, const Frame& frame, uint32_t width, uint32_t height);
/// One layer of an AOV alone. @param view of Graph::views().
ImageF downloadAov(const Graph::View& view, const Frame& frame, const glm::vec3& origin, Device& device,
                   CommandStream& stream);

}  // namespace voxray
