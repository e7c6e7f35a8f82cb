#pragma once

#include <glm/vec3.hpp>

#include "scene/geometry.h"

namespace voxray {

/// Whether a triangle may emit anywhere: its material emits, and its alpha mask leaves some of it, as far as
/// vertices tell that; a texture is not looked at.
bool canEmit(const SceneState& state, uint32_t triangle);

/// Radiance that a triangle's emitting side sends out, W/(m² sr): a mean over its area, nothing where its
/// alpha mask cuts it away. It steers how light is sampled: exact where no texture is read, else of a few
/// points and never 0 where `canEmit`, so that what shines between the points has its chance too.
glm::vec3 meanEmission(const SceneState& state, uint32_t triangle);

}  // namespace voxray
