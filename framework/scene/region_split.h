#pragma once

#include "scene/geometry.h"

namespace voxray {

/// The scene of an evaluated state with triangles cut in two where they pass through the border of a box, so
/// that each lies inside or outside: the same surfaces. Attributes at a cut are interpolated. What moves
/// stays whole.
std::shared_ptr<Scene> splitAtBorder(const SceneState& state, const Box& box);

/// Whether a triangle is in the geometry's region, where that is a part of the scene.
bool isInRegion(const Geometry& geometry, uint32_t triangle);

}  // namespace voxray
