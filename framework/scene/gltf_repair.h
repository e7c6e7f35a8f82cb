#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace voxray {

/// Rewrites what the parser refuses and others read, and what extensions say in place of the core:
/// animation channels without a target node, skins without matrices, cameras without a near plane, textures
/// whose image an extension names, KHR_materials_pbrSpecularGlossiness.
/// @return what was left out, a line each. @throws Error for members of another type
std::vector<std::string> repairGltf(nlohmann::json& root);

}  // namespace voxray
