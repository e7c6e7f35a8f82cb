#pragma once

#include <vector>

#include "passes/common/triangle_walk/voxel_region.h"
#include "vulkan/commands.h"

namespace voxray {

/// Triangles cut into tiles of 8x8 columns of voxels, seen along the axis that each faces most, so that no
/// thread walks all of a large one: what exact.glsl works on.
class TriangleTiles {
 public:
    /// The tiles of `triangles` that may reach into the region.
    TriangleTiles(CommandStream& stream, const Geometry& geometry, const gpu::VoxelGrid& grid,
                  const VoxelRegion& region, const std::vector<uint32_t>& triangles);
    TriangleTiles() = default;

    const Buffer& buffer() const { return buffer_; }
    uint32_t count() const { return count_; }

 private:
    Buffer buffer_;
    uint32_t count_ = 0;
};

}  // namespace voxray
