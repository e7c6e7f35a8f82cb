#pragma once

#include <filesystem>

namespace voxray {

/// The source tree from which the program was built. Shaders are compiled from it at run time.
const std::filesystem::path& sourceRoot();

}  // namespace voxray
