#pragma once

#include <cstdint>

#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// Counts on the host the voxels of a grid that static surfaces pass through: the same at all times, 0 where
/// all surfaces move. Triangles are voxelized conservatively along their dominant axis, with alpha masks
/// taken for opaque: all voxels that exact voxelization finds, and about 1 % more. Takes a bit per voxel of
/// the grid.
uint32_t countStaticVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
