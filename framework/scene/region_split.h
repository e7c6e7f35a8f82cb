#pragma once

#include "scene/geometry.h"

namespace voxray {

/// A state, evaluated at a time, with a box for its region: triangles are cut in two where they pass through
/// its border, so that each lies inside or outside. The same surfaces; attributes at a cut are interpolated.
/// What moves stays whole.
SceneState inRegion(const SceneState& state, const Box& region, double timeSeconds);

/// Whether a triangle is in the geometry's region, where that is a part of the scene.
bool isInRegion(const Geometry& geometry, uint32_t triangle);

}  // namespace voxray
