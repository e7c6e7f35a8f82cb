#pragma once

#include "passes/common/triangle_walk/triangle_walk.h"

namespace voxray {

/// A walk that draws triangles: vertex shaders number the corners of `drawnTriangles`.
class RasterWalk : public TriangleWalk {
 public:
    void plan(PassPlan& plan) override;
    void select(PassContext& context, const gpu::VoxelGrid& grid, const VoxelRegion& region,
                const std::vector<uint32_t>& triangles) override;

 protected:
    /// The visitor's bindings, the scene's and `drawnTriangles`.
    std::vector<Binding> allBindings(const PassContext& context, std::span<const Binding> visitor) const;
    uint32_t corners() const { return corners_; }

 private:
    Buffer drawn_;
    uint32_t corners_ = 0;
};

}  // namespace voxray
