#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/scene_additions.h"
#include "config/settings.h"
#include "image/image.h"

/// Where the files that a config names are, and whether they are of a kind that can be read.
namespace voxray {

/// Where scene files and environment maps are looked for, in this order: `scenesOption` (--scenes),
/// $VOXRAY_SCENES, shared/scenes next to the source root, the config's folder. Empty paths are left out.
std::vector<std::filesystem::path> sceneFolders(const std::filesystem::path& scenesOption,
                                                const std::filesystem::path& sourceRoot,
                                                const std::filesystem::path& configFile);

/// The first folder's file of that name; an absolute name stands for itself.
/// @throws UsageError at `where` that lists where it looked.
std::filesystem::path findSceneFile(const std::string& name,
                                    const std::vector<std::filesystem::path>& folders,
                                    const TextLocation& where);

/// @throws UsageError for a built-in scene that isn't there, or takes other parameters.
void checkBuiltin(const SceneSource& source, const std::vector<std::filesystem::path>& folders);

/// @throws UsageError for a file of another format than glTF, by its ending.
void checkFormat(const SceneSource& source);

/// An image for display holds no radiance: what is brighter than white is cut off.
/// @throws UsageError for one as environment map, by its ending.
void checkMapFormat(const SceneSettings& settings);

/// Checks an equirectangular map of radiance that was read from `path`.
/// @throws Error for an image that has not three channels, and one that names the first pixel that is no
/// radiance, and how many there are.
void checkRadiance(const ImageF& map, const std::filesystem::path& path);

}  // namespace voxray
