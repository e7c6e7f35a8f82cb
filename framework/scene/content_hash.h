#pragma once

#include <string>

#include "scene/scene.h"

namespace voxray {

/// Hash of everything in a scene that a renderer can see. The scene's name, its warnings and the hash it
/// already carries are left out.
std::string hashScene(const Scene& scene);

}  // namespace voxray
