#include "passes/voxelize_clipmap/voxelize_clipmap.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "passes/common/radiance/radiance_voxels.h"
#include "passes/common/voxels/voxel_count.h"

namespace voxray {
namespace {

/// A level's grid, whose window is yet to be placed.
gpu::VoxelGrid levelGrid(gpu::VoxelGrid grid, uint32_t level, uint32_t side) {
    grid.voxelSize *= float(1u << level);
    grid.resolution = levelResolution(grid.resolution, level);
    grid.side = side;
    grid.wordsPerRow = (heldVoxels(grid).size.x + 31) / 32;
    return grid;
}

}  // namespace

VoxelizeClipmap::VoxelizeClipmap(const Params& params)
    : params_(params), builder_(makeExactWalk(), params.visibilityRays) {}

void VoxelizeClipmap::declare(PassBuilder& builder) {
    clipmap_ = builder.write<ClipmapVoxels>("clipmap", "surface voxels round the camera, at all scales");
}

void VoxelizeClipmap::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    gpu::VoxelGrid finest = makeVoxelGrid(geometry.region.min, geometry.region.max, params_.resolution);
    finest.directions = params_.directions;
    ClipmapVoxels& clipmap = plan.get(clipmap_);
    clipmap.grid = {finest.origin,     finest.voxelSize,
                    finest.resolution, clipmapLevels(finest.resolution, params_, kName),
                    finest.directions, 1};
    clipmap.windows = ClipmapWindows(clipmap.grid, params_.clipmapResolution);

    const std::vector<uint32_t> counts = plan.ofScene(
        fmt::format("voxels of {} in windows of {}", params_.resolution, params_.clipmapResolution),
        [&] { return countWindowVoxels(geometry, finest, params_.clipmapResolution); });
    clipmap.levels.resize(clipmap.windows.firstWhole() + 1);
    SurfaceVoxels largest;
    for (uint32_t level = 0; level < clipmap.levels.size(); ++level) {
        SurfaceVoxels& voxels = clipmap.levels[level].voxels;
        voxels.unoccludedOnly = params_.visibilityRays > 0;
        voxels.grid = levelGrid(finest, level, params_.clipmapResolution);
        voxels.voxelCount = counts[level];
        VoxelBuilder::planVoxels(plan, voxels);
        // Known as updated up to the next frame.
        plan.reserve("updated voxels (at most)", VoxelBuilder::bytes(voxels));
        largest.voxelCount = std::max(largest.voxelCount, voxels.voxelCount);
    }
    largest.grid = clipmap.levels[0].voxels.grid;
    builder_.planWork(plan, largest, true);
}

void VoxelizeClipmap::prepare(PassSetup& setup) {
    builder_.prepare(setup);
    windows_.clear();
    for (ClipmapVoxels::Level& level : setup.get(clipmap_).levels) level.voxels.materials = {};
}

void VoxelizeClipmap::record(PassContext& context) {
    const Frame& frame = context.frame;
    ClipmapVoxels& clipmap = context.get(clipmap_);
    const bool moved = frame.sceneVersion != sceneVersion_;
    const bool known = !moved || (frame.sceneVersion == sceneVersion_ + 1 && frame.changed);
    const std::vector<gpu::ClipmapWindow> before = known ? windows_ : std::vector<gpu::ClipmapWindow>();
    windows_.clear();
    uint64_t updated = 0;
    for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
        ClipmapVoxels::Level& level = clipmap.levels[l];
        SurfaceVoxels& voxels = level.voxels;
        windows_.push_back(clipmap.windows.window(l, frame.camera.position));
        voxels.grid.first = windows_[l].first;
        level.updated = {};
        if (before.empty()) {
            level.boxes = {heldVoxels(voxels.grid)};
            builder_.build(context, voxels);
        } else {
            level.boxes = scrolledIn(before[l], windows_[l]);
            if (moved)
                std::ranges::copy(changedVoxels(voxels.grid, *frame.changed),
                                  std::back_inserter(level.boxes));
            if (!level.boxes.empty())
                level.updated = builder_.update(context, VoxelRegion(voxels.grid, level.boxes), voxels);
        }
        for (const VoxelBox& box : level.boxes) updated += box.count();
    }
    context.report(kUpdatedVoxels, double(updated));
    sceneVersion_ = frame.sceneVersion;
    if (clipmap.levels.back().voxels.voxelCount == 0)
        throw Error("{}: no surface meets the grid; the scene needs triangles with an area", kName);
}

}  // namespace voxray
