#pragma once

#include <filesystem>
#include <string>

#include "base/error.h"

namespace voxray::pbrt {

/// A file that a scene names, relative to the folder of its root file. @throws Error at a place if there is none
std::filesystem::path findFile(const std::filesystem::path& folder, const std::string& name, const TextLocation& where);

}  // namespace voxray::pbrt
