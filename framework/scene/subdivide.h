#pragma once

#include "scene/scene.h"

namespace voxray {

/// Splits each triangle of a scene in four at the midpoints of its edges, `times` times: the same surfaces of
/// 4^times as many triangles. Attributes are interpolated, normals and tangents normalized. Shared edges
/// share the midpoint. @throws Error for more than 2^28 triangles.
void subdivide(Scene& scene, uint32_t times);

}  // namespace voxray
