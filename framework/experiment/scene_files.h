#pragma once

#include <filesystem>
#include <vector>

#include "image/image.h"

/// Finds the files that a config names, and checks their formats.
namespace voxray {

/// The folders in which scene files and environment maps are searched, in this order: `scenesOption`
/// (--scenes), $VOXRAY_SCENES, shared/scenes next to the source root, the config's folder. Empty ones are
/// skipped.
std::vector<std::filesystem::path> sceneFolders(const std::filesystem::path& scenesOption,
                                                const std::filesystem::path& sourceRoot,
                                                const std::filesystem::path& configFile);

/// Checks an equirectangular map of radiance that was read from `path`.
/// @throws Error for an image without three channels, and for values that are negative or not finite, with
/// the first of these pixels and their number.
void checkRadiance(const ImageF& map, const std::filesystem::path& path);

}  // namespace voxray
