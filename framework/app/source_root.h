#pragma once

#include <filesystem>

namespace voxray {

/// The source tree that the program was built from: its shaders are compiled when they are used.
const std::filesystem::path& sourceRoot();

}  // namespace voxray
