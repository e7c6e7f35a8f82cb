#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.h"

namespace voxray {

/// Areas of surfaces, m².
struct SurfaceAreas {
    double still = 0;   ///< Of triangles that stay where they are.
    double moving = 0;  ///< Of those that move.
};
SurfaceAreas surfaceAreas(const Geometry& geometry);

/// How densely points are spread: so many, not necessarily a whole number, on so much area, m².
struct PointDensity {
    double points = 0;
    double area = 0;
};

/// The triangle of each point where points are spread evenly over the surfaces' area, triangle by triangle:
/// first over those that stay, so that what moves changes none of their points. @param most points at most.
std::vector<uint32_t> spreadPoints(const Geometry& geometry, const PointDensity& density, uint64_t most);

}  // namespace voxray
