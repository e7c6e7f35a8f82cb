#include "passes/cones/clipmap/clipmap_windows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "base/error.h"
#include "passes/common/compute/bit_words.h"
#include "passes/common/voxels/grid_levels.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {
namespace {

/// Voxels between a window's reach and its border: half a voxel for interpolation and half a voxel by which
/// the window, in whole voxels, lags behind the camera.
constexpr float kMargin = 1;

/// Width of the transition to the next level at either end of the reach, as a fraction of the window's size.
/// Up to 1/4 the next level, whose window is twice as large, still counts in full there.
constexpr float kTransition = 1.0f / 8;

constexpr float kUnbounded = 1e30f;

}  // namespace

uint32_t clipmapLevels(glm::uvec3 resolution, const ClipmapParams& params, const std::string& pass) {
    uint32_t least = 1;
    while (glm::compMax(levelResolution(resolution, least - 1)) > params.clipmapResolution) ++least;
    if (params.clipmapLevels < least)
        throw Error(
            "{}: with {} levels no window of {} voxels holds the whole scene of {}x{}x{}; "
            "set 'clipmap_levels' to {} or more, or raise 'clipmap_resolution'",
            pass, params.clipmapLevels, params.clipmapResolution, resolution.x, resolution.y, resolution.z, least);
    return std::min(params.clipmapLevels, gridLevels(resolution));
}

gpu::VoxelGrid levelGrid(const gpu::VoxelGrid& finest, uint32_t level, uint32_t windowSize) {
    gpu::VoxelGrid grid = finest;
    grid.voxelSize *= float(1u << level);
    grid.resolution = levelResolution(finest.resolution, level);
    grid.windowSize = windowSize;
    grid.wordsPerRow = uint32_t(bitWords(windowVoxels(grid).size.x));
    return grid;
}

ClipmapWindows::ClipmapWindows(const gpu::RadianceGrid& grid, uint32_t windowSize)
    : grid_(grid), windowSize_(windowSize) {
    for (uint32_t level = 0; level < grid.levels; ++level) {
        const glm::uvec3 resolution = levelResolution(grid.resolution, level);
        const glm::uvec3 size = glm::min(resolution, glm::uvec3(windowSize));
        if (size != resolution) firstWhole_ = level + 1;
        firstIndices_.push_back(uint32_t(voxels_));
        voxels_ += VoxelBox{glm::ivec3(0), size}.count();
    }
}

gpu::ClipmapWindow ClipmapWindows::window(uint32_t level, const glm::vec3& camera) const {
    const float voxel = grid_.voxelSize * float(1u << level);
    const glm::uvec3 resolution = levelResolution(grid_.resolution, level);
    const float half = 0.5f * float(windowSize_), reach = half - kMargin,
                full = reach - kTransition * float(windowSize_);
    gpu::ClipmapWindow w{};
    w.firstIndex = firstIndices_[level];
    w.falloff = 1 / (kTransition * float(windowSize_) * voxel);
    for (int axis = 0; axis < 3; ++axis) {
        w.size[axis] = std::min(resolution[axis], windowSize_);
        w.reach[axis] = kUnbounded;
        if (resolution[axis] <= windowSize_) continue;

        // The window stops where the level's full weight extends to the grid's border
        const float center = std::clamp((camera[axis] - grid_.origin[axis]) / voxel, full,
                                        float(grid_.resolution[axis]) / float(1u << level) - full);
        w.first[axis] = int(std::round(center - half));
        w.center[axis] = grid_.origin[axis] + voxel * center;
        w.reach[axis] = voxel * reach;
    }
    return w;
}

std::vector<VoxelBox> scrolledIn(const gpu::ClipmapWindow& previous, const gpu::ClipmapWindow& window) {
    std::vector<VoxelBox> boxes;
    VoxelBox remaining{window.first, window.size};
    for (int axis = 0; axis < 3; ++axis) {
        const int moved = window.first[axis] - previous.first[axis];
        if (moved == 0) continue;
        VoxelBox slab = remaining;
        slab.size[axis] = uint32_t(std::min(std::abs(moved), int(remaining.size[axis])));
        if (moved > 0) slab.first[axis] += int(remaining.size[axis] - slab.size[axis]);
        boxes.push_back(slab);
        remaining.size[axis] -= slab.size[axis];
        if (remaining.size[axis] == 0) break;
        if (moved < 0) remaining.first[axis] += int(slab.size[axis]);
    }
    return boxes;
}

}  // namespace voxray
