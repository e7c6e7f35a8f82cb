#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace voxray {

/// Rewrites JSON that the parser refuses, and extensions that replace the core: animation channels without a
/// target node, skins without matrices, cameras without a near plane, textures whose image an extension
/// names, KHR_materials_pbrSpecularGlossiness.
/// @return warnings, one line each. @throws Error for members of another type
std::vector<std::string> repairGltf(nlohmann::json& root);

}  // namespace voxray
