#pragma once

#include <cstdint>
#include <vector>

#include "passes/common/voxels/voxel_box.h"
#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// The voxels to build again where surfaces have changed, of those that a grid holds: voxels that meet a
/// changed box, m, and those within a voxel of it, as far as visibility probes reach. @param more so many
/// voxels farther on each side.
std::vector<VoxelBox> changedVoxels(const gpu::VoxelGrid& grid, const std::vector<Box>& changed,
                                    uint32_t more = 0);

}  // namespace voxray
