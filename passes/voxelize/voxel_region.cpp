#include "passes/voxelize/voxel_region.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>

namespace voxray {
namespace {

/// Voxels from a point on a surface to what may change its exposure: the probe's length, and to spare what
/// its ray starts off the surface.
constexpr float kProbeReach = 1 + 1.0f / 16;

}  // namespace

GridBounds::GridBounds(const Geometry& geometry, const gpu::VoxelGrid& grid, uint32_t triangle) {
    constexpr float kSpare = 1.0f / 256;
    const glm::uvec3 v = geometry.triangles[triangle];
    const glm::vec3 &a = geometry.positions[v.x], &b = geometry.positions[v.y], &c = geometry.positions[v.z];
    low = (glm::min(a, glm::min(b, c)) - grid.origin) / grid.voxelSize - kSpare;
    high = (glm::max(a, glm::max(b, c)) - grid.origin) / grid.voxelSize + kSpare;
}

VoxelRegion::VoxelRegion(const gpu::VoxelGrid& grid)
    : grid_(grid), everywhere_(true), boxes_{{glm::ivec3(0), grid.resolution}} {}

VoxelRegion::VoxelRegion(const gpu::VoxelGrid& grid, const std::vector<Box>& changed)
    : grid_(grid), everywhere_(false) {
    for (const Box& box : changed) {
        const glm::vec3 low = (box.min - grid.origin) / grid.voxelSize - kProbeReach;
        const glm::vec3 high = (box.max - grid.origin) / grid.voxelSize + kProbeReach;
        const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(low)), glm::ivec3(0));
        const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(high)), glm::ivec3(grid.resolution) - 1);
        if (glm::any(glm::greaterThan(first, last))) continue;
        boxes_.push_back({first, glm::uvec3(last - first + 1)});
        const glm::vec3 end(last + 1);
        low_ = boxes_.size() == 1 ? glm::vec3(first) : glm::min(low_, glm::vec3(first));
        high_ = boxes_.size() == 1 ? end : glm::max(high_, end);
    }
}

bool VoxelRegion::meets(const glm::vec3& low, const glm::vec3& high) const {
    const auto meet = [&](const glm::vec3& first, const glm::vec3& end) {
        return glm::all(glm::lessThanEqual(low, end)) && glm::all(glm::greaterThanEqual(high, first));
    };
    if (everywhere_) return true;
    return meet(low_, high_) && std::ranges::any_of(boxes_, [&](const VoxelBox& box) {
               return meet(glm::vec3(box.first), glm::vec3(box.first) + glm::vec3(box.size));
           });
}

std::vector<uint32_t> VoxelRegion::triangles(const Geometry& geometry) const {
    std::vector<uint32_t> found(geometry.triangles.size());
    std::iota(found.begin(), found.end(), 0u);
    if (everywhere_) return found;
    std::erase_if(found, [&](uint32_t triangle) {
        const GridBounds bounds(geometry, grid_, triangle);
        return !meets(bounds.low, bounds.high);
    });
    return found;
}

}  // namespace voxray
