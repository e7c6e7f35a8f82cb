#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.h"

namespace voxray {

/// The triangle of each of `count` points that are spread evenly over the surfaces' area, triangle by
/// triangle.
std::vector<uint32_t> spreadPoints(const Geometry& geometry, uint64_t count);

}  // namespace voxray
