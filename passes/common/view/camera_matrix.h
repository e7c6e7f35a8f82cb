#pragma once

#include <glm/mat4x4.hpp>

#include "graph/pass.h"
#include "scene/camera_rays.h"

namespace voxray {

/// World space to Vulkan clip space (y down) for a pinhole camera. Depth is reversed, 1 on the near plane and
/// 0 on the far one, so that it resolves 10⁻⁶ of a surface's distance. The far plane is behind all of the
/// scene; the distance of the near one depends on the size of its region.
glm::mat4 viewProjection(const Camera& camera, uint32_t width, uint32_t height, const Geometry& geometry);

}  // namespace voxray
