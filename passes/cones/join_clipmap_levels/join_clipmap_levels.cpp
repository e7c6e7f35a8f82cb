#include <algorithm>

#include "graph/registry.h"
#include "passes/common/voxels/level_join.h"
#include "passes/cones/clipmap/clipmap_voxels.h"

namespace voxray {
namespace {

/// A level, with the voxels that it holds: its window without odd ones at its border, so that none is half a
/// voxel of the next level.
gpu::VoxelLevel heldLevel(const gpu::VoxelGrid& window) {
    gpu::VoxelLevel level = wholeLevel(window);
    for (int axis = 0; axis < 3; ++axis) {
        if (window.resolution[axis] <= window.windowSize) continue;
        level.first[axis] = window.first[axis] + (window.first[axis] & 1);
        level.end[axis] = (window.first[axis] + int(window.windowSize)) & ~1;
    }
    return level;
}

/// Estimates the voxels of all levels, as if surfaces were spread evenly over the scene.
double estimateJoined(const Geometry& geometry, const ClipmapVoxels& clipmap) {
    double voxels = 0, finer = 0;
    for (const ClipmapVoxels::Level& level : clipmap.levels) {
        const gpu::VoxelGrid& grid = level.voxels.grid;
        const double window = double(windowVoxels(grid).count()), whole = double(VoxelBox{{}, grid.resolution}.count());
        voxels += estimateVoxels(geometry, grid) * std::max(0.0, window - finer) / whole;
        finer = window / 8;
    }
    return voxels;
}

}  // namespace

/// Joins the levels of a clipmap to voxels that are numbered through, so that irradiance is stored in windows round
/// the camera. Docs: docs/injection.md.
class JoinClipmapLevels final : public Pass {
 public:
    static constexpr const char* kName = "join_clipmap_levels";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Makes one list of the voxels of voxelize_clipmap's levels, to be lit and looked up. "
        "A place has a voxel at the finest level whose window holds it. Read by inject_light_rays, gather_irradiance "
        "and gather_rays. "
        "Biased by: distance from the camera; light changes at the borders of windows. "
        "Source: Magalhães 2020, section 3.2.5.3, which names clipmaps as the store to prefer, and builds none.";

    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    In<ClipmapVoxels> clipmap_{*this, "clipmap", "surface voxels of each level's window"};
    Out<VoxelLevels> voxels_{*this, "voxels", "surface voxels of all levels, numbered through"};
    LevelJoin join_{*this};
};

void JoinClipmapLevels::plan(PassPlan& plan) {
    const ClipmapVoxels& clipmap = plan[clipmap_];
    VoxelLevels& joined = plan[voxels_];
    joined.grid = clipmap.levels[0].voxels.grid;
    joined.areasAreUnoccluded = clipmap.levels[0].voxels.areasAreUnoccluded;
    joined.estimatedCount = estimateJoined(plan.frame.scene->geometry, clipmap);
    uint64_t words = 0;
    for (const ClipmapVoxels::Level& level : clipmap.levels) words += level.voxels.words();
    plan.buffer(joined.levels, "levels of voxels", clipmap.levels.size() * sizeof(gpu::VoxelLevel));
    plan.buffer(joined.occupancy, "voxel occupancy", words * sizeof(uint32_t));
    plan.buffer(joined.rank, "voxel ranks", words * sizeof(uint32_t));
    plan.estimate(joined.estimatedCount * kAreaWords * sizeof(uint32_t));
}

void JoinClipmapLevels::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    std::vector<LevelSource> sources;
    for (const ClipmapVoxels::Level& level : context[clipmap_].levels)
        sources.push_back({heldLevel(level.voxels.grid), &level.voxels});
    join_.run(context, sources, context[voxels_]);
}

VOXRAY_REGISTER_PASS(JoinClipmapLevels);

}  // namespace voxray
