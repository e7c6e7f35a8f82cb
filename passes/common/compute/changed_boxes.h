#pragma once

#include <vector>

#include "graph/pass.h"

namespace voxray {

/// Uploads boxes in which surfaces have changed (m), enlarged by 1/64 voxel for rounding errors, for shaders that
/// include changed_boxes.glsl. @param changed must not be empty. @param voxelSize m
Buffer changedBoxes(CommandStream& stream, const std::vector<Box>& changed, float voxelSize);

}  // namespace voxray
