#include <algorithm>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/voxel_builder/voxel_builder.h"
#include "passes/cones/clipmap/clipmap_voxels.h"

namespace voxray {

/// Voxelizes triangles into a clipmap whose windows follow the camera: what scrolls in is voxelized, and
/// where surfaces moved, their old and new voxels. Docs: docs/clipmap.md.
class VoxelizeClipmap final : public Pass {
 public:
    static constexpr const char* kName = "voxelize_clipmap";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Voxelizes the scene's surfaces into a clipmap around the camera, for light_clipmap. "
        "The coarsest level covers the whole scene, each finer level a window. "
        "Memory depends on the windows, not on the scene, except for 8 bytes per triangle or more. "
        "Each frame voxelizes what scrolled in or moved, as voxelize's method exact. "
        "Biased by: distance from the camera; a gap narrower than a voxel of its level is closed. "
        "Source: Arnebäck 2017, section 4.1.1, after Panteleev 2014.";
    struct Params : ClipmapParams, VoxelBuildParams {
        uint32_t resolution = 128;
        static constexpr auto schema() {
            return std::tuple_cat(std::tuple{field("resolution", &Params::resolution,
                                                   "Voxels of the finest level along the scene's longest axis, "
                                                   "if its window were the whole scene.",
                                                   1u, 1024u)},
                                  ClipmapParams::schema(), VoxelBuildParams::schema());
        }
    };

    explicit VoxelizeClipmap(const Params& params) : params_(params) {}
    Phase phase() const override { return Phase::Frame; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    Out<ClipmapVoxels> clipmap_{*this, "clipmap", "surface voxels around the camera, at all scales"};
    VoxelBuilder builder_{*this, makeExactVoxelizer(), params_.visibilityRays};
    std::vector<gpu::ClipmapWindow> windows_;  ///< Of the last frame, by level.
    uint64_t sceneVersion_ = 0;                ///< Of the last frame.
};

void VoxelizeClipmap::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    gpu::VoxelGrid finest = makeVoxelGrid(geometry.region.min, geometry.region.max, params_.resolution);
    finest.directions = params_.directions;
    ClipmapVoxels& clipmap = plan[clipmap_];
    clipmap.grid = {finest.origin,     finest.voxelSize,
                    finest.resolution, clipmapLevels(finest.resolution, params_, kName),
                    finest.directions, 1};
    clipmap.windows = ClipmapWindows(clipmap.grid, params_.clipmapResolution);

    clipmap.levels.resize(clipmap.windows.firstWhole() + 1);
    for (uint32_t level = 0; level < clipmap.levels.size(); ++level) {
        SurfaceVoxels& voxels = clipmap.levels[level].voxels;
        voxels.areasAreUnoccluded = params_.visibilityRays > 0;
        voxels.grid = levelGrid(finest, level, params_.clipmapResolution);
        VoxelBuilder::planVoxels(plan, voxels);
    }
    builder_.planWork(plan);
}

void VoxelizeClipmap::record(PassContext& context) {
    const Frame& frame = context.frame;
    ClipmapVoxels& clipmap = context[clipmap_];
    const bool moved = frame.sceneVersion != sceneVersion_;
    const bool changesAreKnown = !moved || (frame.sceneVersion == sceneVersion_ + 1 && frame.changedRegions);
    const std::vector<gpu::ClipmapWindow> previous = changesAreKnown ? windows_ : std::vector<gpu::ClipmapWindow>();
    windows_.clear();
    uint64_t updated = 0;
    for (uint32_t l = 0; l < clipmap.levels.size(); ++l) {
        ClipmapVoxels::Level& level = clipmap.levels[l];
        SurfaceVoxels& voxels = level.voxels;
        windows_.push_back(clipmap.windows.window(l, frame.camera.position));
        voxels.grid.first = windows_[l].first;
        level.updated = {};
        if (previous.empty()) {
            level.boxes = {windowVoxels(voxels.grid)};
            builder_.build(context, voxels);
        } else {
            level.boxes = scrolledIn(previous[l], windows_[l]);
            if (moved)
                std::ranges::copy(changedVoxels(voxels.grid, *frame.changedRegions), std::back_inserter(level.boxes));
            if (!level.boxes.empty())
                level.updated = builder_.update(context, VoxelRegion(voxels.grid, level.boxes), voxels);
        }
        for (const VoxelBox& box : level.boxes) updated += box.count();
    }
    context.report(kUpdatedVoxels, double(updated));
    if (updated == 0) context.markOutputsUnchanged();
    sceneVersion_ = frame.sceneVersion;
    if (clipmap.levels.back().voxels.voxelCount == 0)
        throw Error("{}: no surface meets the grid; the scene needs triangles with an area", kName);
}

VOXRAY_REGISTER_PASS(VoxelizeClipmap);

}  // namespace voxray
