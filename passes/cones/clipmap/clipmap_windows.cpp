#include "passes/cones/clipmap/clipmap_windows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "base/error.h"
#include "passes/common/voxels/grid_levels.h"

namespace voxray {
namespace {

/// Voxels by which a window's reach ends short of the window: half a voxel that interpolation needs, and
/// half a voxel by which the window, in whole voxels, may lag behind the camera.
constexpr float kMargin = 1;

/// The part of a window's side, at either end of its reach, over which the next level takes over. Up to a
/// quarter the next level is there in full wherever it is needed, since its window is twice as large.
constexpr float kTransition = 1.0f / 8;

constexpr float kEndless = 1e30f;

}  // namespace

uint32_t clipmapLevels(glm::uvec3 resolution, const ClipmapParams& params, const std::string& pass) {
    uint32_t least = 1;
    while (glm::compMax(levelResolution(resolution, least - 1)) > params.clipmapResolution) ++least;
    if (params.clipmapLevels < least)
        throw Error(
            "{}: with {} levels no window of {} voxels holds the whole scene of {}x{}x{}; set "
            "'clipmap_levels' to {} or more, or raise 'clipmap_resolution'",
            pass, params.clipmapLevels, params.clipmapResolution, resolution.x, resolution.y, resolution.z,
            least);
    return std::min(params.clipmapLevels, gridLevels(resolution));
}

ClipmapWindows::ClipmapWindows(const gpu::RadianceGrid& grid, uint32_t side) : grid_(grid), side_(side) {
    for (uint32_t level = 0; level < grid.levels; ++level) {
        const glm::uvec3 resolution = levelResolution(grid.resolution, level);
        const glm::uvec3 size = glm::min(resolution, glm::uvec3(side));
        if (size != resolution) firstWhole_ = level + 1;
        begin_.push_back(uint32_t(voxels_));
        voxels_ += VoxelBox{glm::ivec3(0), size}.count();
    }
}

gpu::ClipmapWindow ClipmapWindows::window(uint32_t level, const glm::vec3& camera) const {
    const float voxel = grid_.voxelSize * float(1u << level);
    const glm::uvec3 resolution = levelResolution(grid_.resolution, level);
    const float half = 0.5f * float(side_), reach = half - kMargin, full = reach - kTransition * float(side_);
    gpu::ClipmapWindow w{};
    w.begin = begin_[level];
    w.fall = 1 / (kTransition * float(side_) * voxel);
    for (int axis = 0; axis < 3; ++axis) {
        w.size[axis] = std::min(resolution[axis], side_);
        w.reach[axis] = kEndless;
        if (resolution[axis] <= side_) continue;

        // Where the camera comes near to the grid's border, the window stops with all up to the border in
        // full.
        const float center = std::clamp((camera[axis] - grid_.origin[axis]) / voxel, full,
                                        float(grid_.resolution[axis]) / float(1u << level) - full);
        w.first[axis] = int(std::round(center - half));
        w.center[axis] = grid_.origin[axis] + voxel * center;
        w.reach[axis] = voxel * reach;
    }
    return w;
}

std::vector<VoxelBox> scrolledIn(const gpu::ClipmapWindow& before, const gpu::ClipmapWindow& window) {
    std::vector<VoxelBox> boxes;
    VoxelBox rest{window.first, window.size};
    for (int axis = 0; axis < 3; ++axis) {
        const int moved = window.first[axis] - before.first[axis];
        if (moved == 0) continue;
        VoxelBox slab = rest;
        slab.size[axis] = uint32_t(std::min(std::abs(moved), int(rest.size[axis])));
        if (moved > 0) slab.first[axis] += int(rest.size[axis] - slab.size[axis]);
        boxes.push_back(slab);
        rest.size[axis] -= slab.size[axis];
        if (rest.size[axis] == 0) break;
        if (moved < 0) rest.first[axis] += int(slab.size[axis]);
    }
    return boxes;
}

}  // namespace voxray
