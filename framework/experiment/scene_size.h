#pragma once

#include <string>

#include "config/settings.h"
#include "scene/geometry.h"

namespace voxray {

/// What to change where a scene itself takes too much of the device's memory: what it takes for triangles,
/// for textures and for its environment map, and which settings of the config or parts of its file the
/// largest of these grows with.
std::string sceneSizeAdvice(const SceneSettings& settings, const SceneState& state);

}  // namespace voxray
