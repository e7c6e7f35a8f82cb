#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// How many triangles touch each voxel that any touches, in no order: counted on the host without a device,
/// to predict memory. An upper bound, by about a hundredth. What moves counts twice, as in
/// countSurfaceVoxels(). Takes 4 bytes for each pair of a triangle and a voxel.
std::vector<uint32_t> countLeafTriangles(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
