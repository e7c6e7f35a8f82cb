#pragma once

#include "scene/geometry.h"

namespace voxray {

/// A state with a region: triangles across its border are split, so that each lies inside or outside.
/// Attributes at cuts are interpolated. Moving instances are not split. @param timeSeconds that the state was
/// evaluated at.
SceneState splitAtRegion(const SceneState& state, const Box& region, double timeSeconds);

/// Whether a triangle is in the geometry's region.
bool isInRegion(const Geometry& geometry, uint32_t triangle);

/// One-sided area of all surfaces in the region, m².
double surfaceArea(const Geometry& geometry);

}  // namespace voxray
