#include "passes/common/voxel_builder/changed_voxels.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "passes/common/voxels/voxels.h"

namespace voxray {
namespace {

/// Voxels from a point on a surface to what may change its visibility: the probe's length, and a margin for
/// the offset of its ray from the surface.
constexpr float kProbeReach = 1 + 1.0f / 16;

}  // namespace

std::vector<VoxelBox> changedVoxels(const gpu::VoxelGrid& grid, const std::vector<Box>& changed,
                                    uint32_t more) {
    const int beyond = int(more);
    const VoxelBox held = heldVoxels(grid);
    const glm::ivec3 end = held.first + glm::ivec3(held.size);
    std::vector<VoxelBox> boxes;
    for (const Box& box : changed) {
        const glm::vec3 low = (box.min - grid.origin) / grid.voxelSize - kProbeReach;
        const glm::vec3 high = (box.max - grid.origin) / grid.voxelSize + kProbeReach;
        const glm::ivec3 first = glm::max(glm::ivec3(glm::floor(low)) - beyond, held.first);
        const glm::ivec3 last = glm::min(glm::ivec3(glm::floor(high)) + beyond, end - 1);
        if (glm::all(glm::lessThanEqual(first, last))) boxes.push_back({first, glm::uvec3(last - first + 1)});
    }
    return boxes;
}

}  // namespace voxray
