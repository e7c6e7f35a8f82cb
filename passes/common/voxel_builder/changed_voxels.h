#pragma once

#include <cstdint>
#include <vector>

#include "passes/common/voxels/voxel_box.h"
#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// The voxels of a grid's window to rebuild after surfaces have changed: those that overlap a changed box
/// (m), enlarged by the length of visibility probes. @param margin in voxels, by which the result is enlarged
/// further.
std::vector<VoxelBox> changedVoxels(const gpu::VoxelGrid& grid, const std::vector<Box>& changed, uint32_t margin = 0);

}  // namespace voxray
