#pragma once

#include <vector>

#include "passes/common/voxels/voxel_box.h"
#include "scene/geometry.h"
#include "shaders/voxels/voxel_types.h"

namespace voxray {

/// The voxels to voxelize: the whole window of a grid, or boxes of it, which may overlap.
class VoxelRegion {
 public:
    /// The grid's window.
    explicit VoxelRegion(const gpu::VoxelGrid& grid);
    /// Boxes within the grid's window.
    VoxelRegion(const gpu::VoxelGrid& grid, std::vector<VoxelBox> boxes);

    /// The boxes in wrapped coordinates (modulo the window's size): those that cross the seam are split.
    std::vector<VoxelBox> wrappedBoxes() const;
    /// Bounds of all boxes, in grid coordinates.
    const glm::vec3& low() const { return low_; }
    const glm::vec3& high() const { return high_; }

    /// Whether a closed box in grid coordinates overlaps the region.
    bool overlaps(const glm::vec3& low, const glm::vec3& high) const;
    /// The triangles that may overlap the region, in ascending order.
    std::vector<uint32_t> triangles(const Geometry& geometry) const;

 private:
    gpu::VoxelGrid grid_;
    std::vector<VoxelBox> boxes_;
    glm::vec3 low_{0}, high_{0};
};

/// A triangle's bounds in grid coordinates, enlarged by more than the margin of grid_triangle.glsl.
struct GridBounds {
    GridBounds(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t triangle);
    glm::vec3 low, high;
};

}  // namespace voxray
