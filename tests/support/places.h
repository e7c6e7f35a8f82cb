#pragma once

#include <filesystem>

namespace voxray::test {

/// The source tree that the tests were built from.
const std::filesystem::path& sourceRoot();

/// The build's folder for compiled shaders, one for all programs that compile many.
const std::filesystem::path& shaderCache();

/// The folder of test scenes: $VOXRAY_SCENES, else shared/scenes next to the source tree. It may not exist.
std::filesystem::path scenesFolder();

}  // namespace voxray::test
