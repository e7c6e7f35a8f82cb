#pragma once

#include "scene/memory_budget.h"
#include "scene/scene.h"

namespace voxray {

/// The limit surface of Loop's subdivision scheme, sampled at the vertices after some levels, with its normals.
/// Borders are smooth curves. Positions and triangles alone are read. Normals are towards the triangles' fronts.
/// Source: Loop 1987; weights with β(3) = 3/16, β(n) = 3/(8n), limit and tangent masks as Pharr et al., Physically
/// Based Rendering, 3rd edition, section 3.8. Where more than two triangles meet at an edge it is a border of each.
/// @param levels each makes four triangles of one
/// @throws Error for more memory than the bound
Mesh loopSubdivided(const Mesh& control, uint32_t levels, MemoryBudget& memory);

}  // namespace voxray
