#include "passes/voxelize/voxelize_pass.h"

#include <fmt/format.h>

#include "base/error.h"
#include "passes/common/voxels/voxel_count.h"

namespace voxray {
namespace {

std::unique_ptr<TriangleWalk> makeWalk(const VoxelizePass::Params& params) {
    switch (params.method) {
        case VoxelizeMethodName::ThreeAxis:
            return makeThreeAxisWalk(params.samplesPerVoxelEdge);
        case VoxelizeMethodName::DominantAxis:
            return makeDominantAxisWalk();
        default:
            return makeExactWalk();
    }
}

}  // namespace

VoxelizePass::VoxelizePass(const Params& params)
    : params_(params), builder_(makeWalk(params), params.visibilityRays) {}

void VoxelizePass::declare(PassBuilder& builder) {
    voxels_ = builder.write<SurfaceVoxels>("voxels", "surface voxels with their materials");
}

void VoxelizePass::plan(PassPlan& plan) {
    const Geometry& geometry = plan.frame.scene->geometry;
    SurfaceVoxels& v = plan.get(voxels_);
    v.unoccludedOnly = params_.visibilityRays > 0;
    v.grid = makeVoxelGrid(geometry.region.min, geometry.region.max, params_.resolution);
    v.grid.directions = params_.directions;
    v.expectedCounts = plan.ofScene(fmt::format("voxels of {}", params_.resolution),
                                    [&] { return countSurfaceVoxels(geometry, v.grid); });
    v.voxelCount = v.expectedCounts.front();
    const bool moves = !movingRuns(geometry).empty();
    if (moves)
        v.stillCount = plan.ofScene(fmt::format("still voxels of {}", params_.resolution),
                                    [&] { return countStillVoxels(geometry, v.grid); });
    VoxelBuilder::planVoxels(plan, v);
    builder_.planWork(plan, v, moves);
}

void VoxelizePass::prepare(PassSetup& setup) {
    setup.get(voxels_).materials = {};
    builder_.prepare(setup);
}

void VoxelizePass::record(PassContext& context) {
    SurfaceVoxels& v = context.get(voxels_);
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (!changed || !v.materials)
        builder_.build(context, v);
    else if (!changed->empty())
        builder_.update(context, VoxelRegion(v.grid, changedVoxels(v.grid, *changed)), v);
    if (v.voxelCount == 0)
        throw Error(
            "voxelize: no surface meets the grid of {}x{}x{} voxels; the scene needs triangles with an area, "
            "and three_axis more 'samples_per_voxel_edge'",
            v.grid.resolution.x, v.grid.resolution.y, v.grid.resolution.z);
}

}  // namespace voxray
