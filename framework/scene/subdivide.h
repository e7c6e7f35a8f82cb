#pragma once

#include "scene/scene.h"

namespace voxray {

/// Splits each triangle of a scene in four, at the midpoints of its edges, `times` over: the same surfaces of
/// 4^times as many triangles. Attributes at a midpoint are the mean of those at the edge's ends, normals and
/// tangents of unit length. A common edge has one midpoint, so that no gap opens.
/// @throws Error where that makes more than 2^28 triangles.
void subdivide(Scene& scene, uint32_t times);

}  // namespace voxray
