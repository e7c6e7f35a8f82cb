#pragma once

#include <string>

#include "scene/scene.h"

namespace voxray {

/// Hash of everything in a scene that affects rendering: not of its name, its warnings and its present hash.
std::string hashScene(const Scene& scene);

}  // namespace voxray
