#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace voxray {

/// The text at a path of keys in a JSON object, "" where there is none. What follows it is not read: it may
/// be of thousands of variants.
std::string jsonTextAt(std::string_view json, const std::vector<std::string>& path);

}  // namespace voxray
