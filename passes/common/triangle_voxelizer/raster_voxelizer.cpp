#include "passes/common/triangle_voxelizer/raster_voxelizer.h"

#include <algorithm>

namespace voxray {

void RasterVoxelizer::plan(PassPlan& plan) {
    const size_t triangles = plan.frame.scene->geometry.triangles.size();
    plan.scratchBuffer(drawn_, "triangles to draw", std::max<size_t>(triangles, 1) * sizeof(uint32_t));
}

void RasterVoxelizer::select(PassContext& context, const gpu::VoxelGrid&, const VoxelRegion&,
                             const std::vector<uint32_t>& triangles) {
    corners_ = uint32_t(3 * triangles.size());
    if (!triangles.empty()) context.stream.upload(drawn_, triangles);
}

std::vector<Binding> RasterVoxelizer::allBindings(const PassContext& context, std::span<const Binding> callback) const {
    std::vector<Binding> bindings = context.scene.bindings();
    bindings.emplace_back("drawnTriangles", drawn_);
    bindings.insert(bindings.end(), callback.begin(), callback.end());
    return bindings;
}

}  // namespace voxray
