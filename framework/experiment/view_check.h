#pragma once

#include <string>

#include "config/config.h"
#include "experiment/scene_setup.h"
#include "graph/preview.h"

namespace voxray {

/// Looks at a scene through a variant's camera, before anything is rendered there: a small path-traced image
/// of few samples, and while that is black of more.
/// @return what to warn of where no light was found, with the place in the config; else empty. It may be so
/// by intention, as in a room that light must not leak into.
/// @throws UsageError where no surface lies in view, and where what is seen is dark and mostly shows its
/// back: the camera stands outside of a closed room or inside of a solid.
std::string checkView(const Setup& setup, const PreparedScene& prepared, const Preview& preview);

}  // namespace voxray
