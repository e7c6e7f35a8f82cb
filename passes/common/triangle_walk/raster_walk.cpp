#include "passes/common/triangle_walk/raster_walk.h"

#include <algorithm>

namespace voxray {

void RasterWalk::plan(PassPlan& plan) {
    const size_t triangles = plan.frame.scene->geometry.triangles.size();
    plan.scratchBuffer(drawn_, "triangles to draw", std::max<size_t>(triangles, 1) * sizeof(uint32_t));
}

void RasterWalk::select(PassContext& context, const gpu::VoxelGrid&, const VoxelRegion&,
                        const std::vector<uint32_t>& triangles) {
    corners_ = uint32_t(3 * triangles.size());
    if (!triangles.empty()) context.stream.upload(drawn_, triangles);
}

std::vector<Binding> RasterWalk::allBindings(const PassContext& context,
                                             std::span<const Binding> visitor) const {
    std::vector<Binding> all = context.scene.bindings({{"drawnTriangles", drawn_}});
    all.insert(all.end(), visitor.begin(), visitor.end());
    return all;
}

}  // namespace voxray
