#pragma once

#include <span>
#include <string>

#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// Advice on light that does not arrive: which object occludes it, and how to remove the object. It is the
/// object that is the only occluder of most rays, with a preference for glass, which is opaque here, then for
/// objects that enclose the scene, as a sky dome.
/// @param rays from points that should be lit to the light; inactive ones (tMax < tMin) are skipped.
/// @return "" if no object is the only occluder of a ray.
std::string occluderAdvice(std::span<const Ray> rays, const SceneState& state, const EmbreeScene& tracer);

}  // namespace voxray
