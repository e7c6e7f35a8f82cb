#include "passes/common/triangle_walk/voxelize_method.h"

#include <algorithm>

namespace voxray {

std::vector<Binding> stepBindings(const PassContext& context, const SurfaceVoxels& voxels,
                                  const VoxelizeStep& step, std::initializer_list<Binding> more) {
    std::vector<Binding> bindings = context.scene.bindings(more);
    if (step.mark) {
        bindings.emplace_back("occupancy", *step.target);
    } else {
        bindings.emplace_back("SumsAt", *step.target);
        bindings.emplace_back("voxelOccupancy", voxels.occupancy);
        bindings.emplace_back("voxelRank", voxels.rank);
    }
    return bindings;
}

void RasterMethod::plan(PassPlan& plan, const SurfaceVoxels&) {
    plan.reserveScratch("triangles to draw", plan.frame.scene->geometry.triangles.size() * sizeof(uint32_t));
}

void RasterMethod::select(PassContext& context, const gpu::VoxelGrid&, const VoxelRegion&,
                          const std::vector<uint32_t>& triangles) {
    corners_ = uint32_t(3 * triangles.size());
    drawn_ = Buffer(context.device, "triangles to draw",
                    std::max<size_t>(triangles.size(), 1) * sizeof(triangles[0]));
    if (!triangles.empty()) context.stream.upload(drawn_, triangles);
}

std::vector<Binding> RasterMethod::bindings(const PassContext& context, const SurfaceVoxels& voxels,
                                            const VoxelizeStep& step) const {
    return stepBindings(context, voxels, step, {{"drawnTriangles", drawn_}});
}

}  // namespace voxray
