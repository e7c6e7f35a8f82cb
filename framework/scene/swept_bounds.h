#pragma once

#include "scene/geometry.h"

namespace voxray {

/// Whether an animation changes the world matrix of what places an instance, its node or its joints: their
/// own or that of a node above.
bool movesInTime(const Scene& scene, const Instance& instance);

/// World-space bounds of an instance at all times of the scene's animation: never too small, and too large
/// where rotations are animated (a sphere round the node's origin stands for every turn) or properties change
/// together.
Box sweptBounds(const Scene& scene, const Instance& instance);

}  // namespace voxray
