#pragma once

#include <string>
#include <vector>

#include "config/settings.h"
#include "scene/geometry.h"
#include "trace/embree_scene.h"

namespace voxray {

/// Whether the config's own lights light anything, by rays from each of them: in all directions that it
/// shines in, and to triangles all over the scene. Lights that move are left out: they may yet come to it.
/// @param tracer of `state`, in the compared frame.
/// @return a warning, with its place in the config, of each light whose rays meet no surface, or the backs of
/// surfaces alone: it points past the scene, stands outside of it or inside of a solid.
std::vector<std::string> lightWarnings(const SceneSettings& scene, const SceneState& state,
                                       const EmbreeScene& tracer);

}  // namespace voxray
