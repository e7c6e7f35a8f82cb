#pragma once

#include <glm/mat4x4.hpp>

#include "graph/pass.h"

namespace voxray {

/// World space to Vulkan clip space (y down, depth 0 to 1) for a pinhole camera; near and far planes enclose
/// the scene.
glm::mat4 viewProjection(const Camera& camera, uint32_t width, uint32_t height, glm::vec3 boundsMin,
                         glm::vec3 boundsMax);

/// Directions of pixel centers: forward + (2 (x + 0.5) / width - 1) * right + (1 - 2 (y + 0.5) / height) *
/// up.
struct CameraRays {
    glm::vec3 origin, forward, right, up;
};
CameraRays cameraRays(const Camera& camera, uint32_t width, uint32_t height);

}  // namespace voxray
