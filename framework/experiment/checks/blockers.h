#pragma once

#include <span>
#include <string>

#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// What to say of light that does not arrive: which object is in its way, and how to take it out. That is the
/// one without which most of the light would come, first of all one of a glass that is opaque here, then one
/// that encloses the scene, as a dome with a sky painted on it.
/// @param ways from points that are to be lit to the light; inactive ones (tMax < tMin) are left out
/// @return "" where nothing is in the way alone
std::string blockerAdvice(std::span<const Ray> ways, const SceneState& state, const EmbreeScene& tracer);

}  // namespace voxray
