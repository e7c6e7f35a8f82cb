#pragma once

#include <cstdint>

#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// Voxels of the grid that what stays passes through, counted on the host: the same at all times, 0 where all
/// moves. A voxel counts where a triangle passes through its column along the axis that the triangle faces
/// most, within the triangle's plane's depth there: all that exact voxelization finds, and about a hundredth
/// more (alpha masks are taken for opaque). Takes a bit for each voxel of the grid.
uint32_t countStaticVoxels(const Geometry& geometry, const gpu::VoxelGrid& grid);

}  // namespace voxray
