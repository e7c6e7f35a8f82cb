#pragma once

#include <span>
#include <string>

#include "config/config.h"
#include "experiment/light_check.h"
#include "experiment/scene_setup.h"

namespace voxray {

/// Whether a pass of the graph voxelizes the scene.
bool isVoxelized(const Setup& setup);

/// What to say of a scene that is many times larger than what the camera sees of it, where voxels are spread
/// over all of it: the region to write into the config. "" where they are not, or where there is a region.
/// @param seen of the image, evenly.
std::string regionWarning(const Setup& setup, const PreparedScene& prepared, const EmbreeScene& tracer,
                          std::span<const SeenPoint> seen);

}  // namespace voxray
