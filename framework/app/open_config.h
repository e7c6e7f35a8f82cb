#pragma once

#include <filesystem>
#include <string>

#include "app/config_options.h"

namespace voxray {

inline constexpr const char* kOpenedHelp =
    "Config file, or a scene file (.glb, .gltf, .xml, .pbrt), of which a config to begin with is made.";

/// Reads a config, or makes the starter config of a scene file (isSceneFile()): as `voxray scene --write-config`,
/// without a file. @param tracer takes the place of the config's, unless it is empty. @throws UsageError, Error.
Experiment openConfig(const std::filesystem::path& file, ConfigArguments arguments, const std::string& tracer);

}  // namespace voxray
