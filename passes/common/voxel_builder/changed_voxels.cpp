#include "passes/common/voxel_builder/changed_voxels.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "passes/common/voxels/voxels.h"

namespace voxray {
namespace {

/// Distance in voxels within which surfaces affect a point's visibility: the length of probe rays, and a
/// margin for their offset from the surface.
constexpr float kProbeReach = 1 + 1.0f / 16;

}  // namespace

std::vector<VoxelBox> changedVoxels(const gpu::VoxelGrid& grid, const std::vector<Box>& changed, uint32_t margin) {
    const int voxels = int(margin);
    const VoxelBox window = windowVoxels(grid);
    const glm::ivec3 end = window.first + glm::ivec3(window.size);
    std::vector<VoxelBox> boxes;
    for (const Box& box : changed) {
        const glm::vec3 low = (box.min - grid.origin) / grid.voxelSize - kProbeReach;
        const glm::vec3 high = (box.max - grid.origin) / grid.voxelSize + kProbeReach;
        const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(low)) - voxels, window.first);
        const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(high)) + voxels, end - 1);
        if (glm::all(glm::lessThanEqual(first, last))) boxes.push_back({first, glm::uvec3(last - first + 1)});
    }
    return boxes;
}

}  // namespace voxray
