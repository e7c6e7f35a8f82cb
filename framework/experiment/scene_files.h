#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/scene_additions.h"
#include "config/settings.h"
#include "image/image.h"

/// Finds the files that a config names, and checks their formats.
namespace voxray {

/// The folders in which scene files and environment maps are searched, in this order: `scenesOption`
/// (--scenes), $VOXRAY_SCENES, shared/scenes next to the source root, the config's folder. Empty ones are
/// skipped.
std::vector<std::filesystem::path> sceneFolders(const std::filesystem::path& scenesOption,
                                                const std::filesystem::path& sourceRoot,
                                                const std::filesystem::path& configFile);

/// The path of a file in the first folder that has it; absolute names are returned as they are.
/// @throws UsageError at `where` with the folders that were searched.
std::filesystem::path findSceneFile(const std::string& name,
                                    const std::vector<std::filesystem::path>& folders,
                                    const TextLocation& where);

/// @throws UsageError for a built-in scene that doesn't exist or has no such parameters.
void checkBuiltin(const SceneSource& source, const std::vector<std::filesystem::path>& folders);

/// @throws UsageError if the extension of the file is not one of glTF.
void checkFormat(const SceneSource& source);

/// @throws UsageError if the extension of the environment map is that of an LDR format, which has no
/// radiance.
void checkMapFormat(const SceneSettings& settings);

/// Checks an equirectangular map of radiance that was read from `path`.
/// @throws Error for an image without three channels, and for values that are negative or not finite, with
/// the first of these pixels and their number.
void checkRadiance(const ImageF& map, const std::filesystem::path& path);

}  // namespace voxray
