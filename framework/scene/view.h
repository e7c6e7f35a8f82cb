#pragma once

#include <cstdint>

#include "scene/geometry.h"

namespace voxray {

/// Whether any triangle, occluded or not, intersects the view frustum.
bool isInView(const Geometry& geometry, const Camera& camera, uint32_t width, uint32_t height);

}  // namespace voxray
