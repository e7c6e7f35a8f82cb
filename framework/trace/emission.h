#pragma once

#include <glm/vec3.hpp>

#include "scene/geometry.h"

namespace voxray {

/// Whether a triangle may emit anywhere: its material emits, and its vertices' alpha is not all below the
/// cutoff. Textures are ignored.
bool canEmit(const SceneState& state, uint32_t triangle);

/// Mean emitted radiance of a triangle, W/(m² sr), 0 where its alpha mask removes it. For light sampling:
/// exact without textures, else estimated from a few points, and never 0 if `canEmit`, which keeps sampling
/// unbiased.
glm::vec3 meanEmission(const SceneState& state, uint32_t triangle);

}  // namespace voxray
