#pragma once

#include <vector>

#include "passes/common/voxels/voxel_box.h"
#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// The voxels that a walk visits: all that a grid holds, or boxes of it, which may overlap.
class VoxelRegion {
 public:
    /// All that the grid holds.
    explicit VoxelRegion(const gpu::VoxelGrid& grid);
    /// Boxes of what the grid holds.
    VoxelRegion(const gpu::VoxelGrid& grid, std::vector<VoxelBox> boxes);

    const std::vector<VoxelBox>& boxes() const { return boxes_; }
    /// The same as boxes of slots: those that lie across a window's seam in parts.
    std::vector<VoxelBox> slots() const;
    /// A box round all boxes, in grid coordinates.
    const glm::vec3& low() const { return low_; }
    const glm::vec3& high() const { return high_; }

    /// Whether a box in grid coordinates, closed, meets the region.
    bool meets(const glm::vec3& low, const glm::vec3& high) const;
    /// The triangles that may have a part in the region, in ascending order.
    std::vector<uint32_t> triangles(const Geometry& geometry) const;

 private:
    gpu::VoxelGrid grid_;
    std::vector<VoxelBox> boxes_;
    glm::vec3 low_{0}, high_{0};
};

/// A triangle's bounds in grid coordinates, larger by more than the margin of grid_triangle.glsl.
struct GridBounds {
    GridBounds(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t triangle);
    glm::vec3 low, high;
};

}  // namespace voxray
