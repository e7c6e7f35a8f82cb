#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.h"

namespace voxray {

/// Areas of the surfaces in the region, m².
struct SurfaceAreas {
    double ofStatic = 0;
    double ofMoving = 0;
};
SurfaceAreas surfaceAreas(const Geometry& geometry);

/// Points per area: `points` need not be a whole number; `area` in m².
struct PointDensity {
    double points = 0;
    double area = 0;
};

/// Distributes points evenly over the area of the surfaces in the region. @return the triangle of each point:
/// first those of static surfaces, so that their points don't depend on what moves.
std::vector<uint32_t> distributePoints(const Geometry& geometry, const PointDensity& density);

}  // namespace voxray
