#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "image/score.h"

namespace voxray {

/// The text at a path of keys in a JSON object, "" where there is none. What follows it is not read: it may
/// be of thousands of variants.
std::string jsonTextAt(std::string_view json, const std::vector<std::string>& path);

/// A number; as text where it is infinite, which JSON has not: PSNR of equal images.
nlohmann::ordered_json numberJson(double value);

/// Scores by column, each with `suffix` behind it.
nlohmann::ordered_json scoresJson(const Scores& scores, const std::string& suffix = "");

}  // namespace voxray
