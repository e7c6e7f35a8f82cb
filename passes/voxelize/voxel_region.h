#pragma once

#include <vector>

#include "passes/common/voxel_box.h"
#include "scene/geometry.h"
#include "shaders/shared/voxel_types.h"

namespace voxray {

/// The voxels to make anew: all of a grid, or boxes of it, which may overlap.
class VoxelRegion {
 public:
    /// All of the grid.
    explicit VoxelRegion(const gpu::VoxelGrid& grid);
    /// What changes where surfaces do: the voxels that meet a changed box, m, and those within a voxel of it,
    /// as far as exposure probes reach.
    VoxelRegion(const gpu::VoxelGrid& grid, const std::vector<Box>& changed);

    bool everywhere() const { return everywhere_; }
    const std::vector<VoxelBox>& boxes() const { return boxes_; }

    /// Whether a box in grid coordinates, closed, meets the region.
    bool meets(const glm::vec3& low, const glm::vec3& high) const;
    /// The triangles that may have a part in the region, in ascending order.
    std::vector<uint32_t> triangles(const Geometry& geometry) const;

 private:
    gpu::VoxelGrid grid_;
    bool everywhere_;
    std::vector<VoxelBox> boxes_;
    glm::vec3 low_{0}, high_{0};  ///< Round all boxes, in grid coordinates.
};

/// A triangle's bounds in grid coordinates, larger by more than the margin of grid_triangle.glsl.
struct GridBounds {
    GridBounds(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t triangle);
    glm::vec3 low, high;
};

}  // namespace voxray
