#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace voxray {

/// Checks what the parser doesn't: versions, required extensions, types of the top-level arrays, and bounds
/// of buffer views. @return extensions that the file uses, but doesn't require, and that are ignored
/// @throws Error without the file's name.
std::vector<std::string> checkGltf(const nlohmann::json& root);

}  // namespace voxray
