#pragma once

#include <cstdint>

#include "scene/geometry.h"

namespace voxray {

/// Whether any triangle reaches into what a camera sees, hidden or not: with none, an image of that size is
/// empty.
bool isInView(const Geometry& geometry, const Camera& camera, uint32_t width, uint32_t height);

}  // namespace voxray
