#include "passes/common/triangle_voxelizer/voxel_region.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <utility>

#include "passes/common/voxels/voxels.h"
#include "scene/region_split.h"

namespace voxray {
GridBounds::GridBounds(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t triangle) {
    constexpr float kSpare = 1.0f / 256;
    const glm::uvec3 v = geometry.triangles[triangle];
    const glm::vec3 &a = geometry.positions[v.x], &b = geometry.positions[v.y], &c = geometry.positions[v.z];
    low = (glm::min(a, glm::min(b, c)) - grid.origin) / grid.voxelSize - kSpare;
    high = (glm::max(a, glm::max(b, c)) - grid.origin) / grid.voxelSize + kSpare;
}

VoxelRegion::VoxelRegion(const gpu::VoxelGrid& grid) : VoxelRegion(grid, {windowVoxels(grid)}) {}

VoxelRegion::VoxelRegion(const gpu::VoxelGrid& grid, std::vector<VoxelBox> boxes)
    : grid_(grid), boxes_(std::move(boxes)) {
    for (const VoxelBox& box : boxes_) {
        const glm::vec3 first(box.first), end = first + glm::vec3(box.size);
        low_ = &box == &boxes_[0] ? first : glm::min(low_, first);
        high_ = &box == &boxes_[0] ? end : glm::max(high_, end);
    }
}

std::vector<VoxelBox> VoxelRegion::wrappedBoxes() const {
    const int windowSize = int(grid_.windowSize);
    std::vector<VoxelBox> split = boxes_;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<VoxelBox> whole = std::move(split);
        split.clear();
        for (VoxelBox box : whole) {
            box.first[axis] &= windowSize - 1;
            const int excess = box.first[axis] + int(box.size[axis]) - windowSize;
            if (excess > 0) {
                VoxelBox wrapped = box;
                wrapped.first[axis] = 0;
                wrapped.size[axis] = uint32_t(excess);
                split.push_back(wrapped);
                box.size[axis] -= uint32_t(excess);
            }
            split.push_back(box);
        }
    }
    return split;
}

bool VoxelRegion::overlaps(const glm::vec3& low, const glm::vec3& high) const {
    const auto overlapsBox = [&](const glm::vec3& first, const glm::vec3& end) {
        return glm::all(glm::lessThanEqual(low, end)) && glm::all(glm::greaterThanEqual(high, first));
    };
    return overlapsBox(low_, high_) && std::ranges::any_of(boxes_, [&](const VoxelBox& box) {
               return overlapsBox(glm::vec3(box.first), glm::vec3(box.first) + glm::vec3(box.size));
           });
}

std::vector<uint32_t> VoxelRegion::triangles(const Geometry& geometry) const {
    std::vector<uint32_t> found(geometry.triangles.size());
    std::iota(found.begin(), found.end(), 0u);
    std::erase_if(found, [&](uint32_t triangle) {
        const GridBounds bounds(geometry, grid_, triangle);
        return !isInRegion(geometry, triangle) || !overlaps(bounds.low, bounds.high);
    });
    return found;
}

}  // namespace voxray
