#pragma once

#include <glm/mat4x4.hpp>

#include "graph/pass.h"
#include "scene/camera_rays.h"

namespace voxray {

/// World space to Vulkan clip space (y down) for a pinhole camera. Depth is reversed, 1 on the near plane and
/// 0 on the far one, so that surfaces 10⁻⁶ of their distance apart are told apart; the far plane is behind
/// all of the scene, the near one by the size of its region before the camera.
glm::mat4 viewProjection(const Camera& camera, uint32_t width, uint32_t height, const Geometry& geometry);

}  // namespace voxray
