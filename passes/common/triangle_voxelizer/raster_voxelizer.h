#pragma once

#include "passes/common/triangle_voxelizer/triangle_voxelizer.h"

namespace voxray {

/// A voxelizer that draws triangles: vertex shaders fetch the corners of `drawnTriangles`.
class RasterVoxelizer : public TriangleVoxelizer {
 public:
    void plan(PassPlan& plan) override;
    void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                const std::vector<uint32_t>& triangles) override;

 protected:
    /// The callback's bindings, the scene's and `drawnTriangles`.
    std::vector<Binding> allBindings(const PassContext& context, std::span<const Binding> callback) const;
    uint32_t corners() const { return corners_; }

 private:
    Buffer drawn_;
    uint32_t corners_ = 0;
};

}  // namespace voxray
