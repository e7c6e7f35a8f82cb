#pragma once

#include <glm/mat4x4.hpp>

#include "graph/pass.h"
#include "scene/camera_rays.h"

namespace voxray {

/// World space to Vulkan clip space (y down, depth 0 to 1) for a pinhole camera; near and far planes enclose
/// the scene.
glm::mat4 viewProjection(const Camera& camera, uint32_t width, uint32_t height, glm::vec3 boundsMin,
                         glm::vec3 boundsMax);

}  // namespace voxray
