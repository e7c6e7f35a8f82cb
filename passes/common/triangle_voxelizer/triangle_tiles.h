#pragma once

#include <vector>

#include "passes/common/triangle_voxelizer/voxel_region.h"
#include "vulkan/commands.h"

namespace voxray {

/// Triangles divided into tiles of 8x8 columns of voxels along their dominant axes, so that no thread
/// processes all of a large one. Input of exact.glsl.
class TriangleTiles {
 public:
    /// The tiles of `triangles` that may overlap the region.
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
