#pragma once

#include <string>
#include <vector>

#include "config/config.h"
#include "experiment/scene_setup.h"
#include "graph/preview.h"

namespace voxray {

/// Looks at a scene through a variant's camera, before anything is rendered there: a small path-traced image
/// of few samples, and while that is black of more.
/// @return warnings, each with its place in the config: lights of the config that light nothing that is seen
/// (lightWarnings()); a scene much larger than what is seen (regionWarning()); an angle of view that is in
/// radians; surfaces that fill less than a hundredth of the view; a view in which no light was found, as may
/// be by intention in a room that light must not leak into; one that is nearly all white or black at the
/// config's exposure (exposureWarning()).
/// @throws UsageError where no surface lies in view, and where what is seen is dark and mostly shows its
/// back: the camera stands outside of a closed room or inside of a solid.
ViewCheck checkView(const Setup& setup, const PreparedScene& prepared, const Preview& preview);

/// All that checkView() finds depends on, but for places in the config. @param sceneKey SceneLoader::key().
std::string viewKey(const Setup& setup, const std::string& sceneKey);

}  // namespace voxray
