#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace voxray {

/// Checks what a parser takes on trust: versions, required extensions, the kinds of the top-level arrays, and
/// that buffer views lie in their buffers.
/// @return extensions that the file uses, does not require, and that are left out
/// @throws Error without the file's name.
std::vector<std::string> checkGltf(const nlohmann::json& root);

}  // namespace voxray
