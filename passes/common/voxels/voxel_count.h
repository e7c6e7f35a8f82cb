#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// Voxels that hold surfaces, counted on the host without a device, to predict memory: for each level of ever
/// larger voxels, from those of the grid to a single one. A voxel counts where a triangle passes through its
/// column along the axis that the triangle faces most, within the triangle's plane's depth there: all that
/// exact voxelization finds, and about a hundredth more (alpha masks are taken for opaque). What moves counts
/// twice, so that there is room wherever it goes: a surface meets up to sqrt(3) times as many voxels after a
/// turn, and those that it shares with what stays are others elsewhere. Takes a bit for each voxel of the
/// grid.
std::vector<uint32_t> countSurfaceVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

/// The same for windows of at most `side` voxels along each axis, a power of two from 4 on: the most that a
/// window holds, wherever it is. An upper bound: windows are counted in blocks a quarter as wide, of which
/// one meets up to five along an axis.
std::vector<uint32_t> countWindowVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t side);

/// Voxels of the grid that what stays passes through, counted likewise: the same at all times, 0 where all
/// moves.
uint32_t countStillVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
