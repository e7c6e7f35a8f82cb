#pragma once

#include "scene/geometry.h"

namespace voxray {

/// Whether an instance is animated: the world matrix of its node or one of its joints changes, or a weight of
/// its morph targets.
bool movesInTime(const Scene& scene, const Instance& instance);

/// World-space bounds of an instance over all times of the scene's animation. Conservative: too large if
/// rotations are animated (bounded by a sphere round the node's origin) or properties change together.
Box sweptBounds(const Scene& scene, const Instance& instance);

}  // namespace voxray
