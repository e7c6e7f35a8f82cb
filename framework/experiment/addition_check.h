#pragma once

#include <string>
#include <vector>

#include "experiment/scene_setup.h"

namespace voxray {

/// Whether scenes that a config adds fit the one that they are added to: a scene in centimetres is 100 times
/// too large among metres, and metres are 100 times too small among centimetres.
/// @param prepared of `scene`; `loader` has loaded it.
/// @return a warning, with its place in the config, of each that is 100 times as large as the scene or more,
/// a hundredth of it or less, or 100 times its size away. A scene that is flat, such as a ground, may have
/// any size.
std::vector<std::string> additionWarnings(const SceneSettings& scene, const PreparedScene& prepared,
                                          SceneLoader& loader);

}  // namespace voxray
