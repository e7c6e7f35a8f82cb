#pragma once

#include "passes/clusters/voxel_point_rays.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Finds voxels of which the camera sees one of 12 points around them. Source: Cosin and Patow 2022, section
/// 4.4; docs/clusters.md has our choices where the text leaves one.
class VisiblePoints {
 public:
    explicit VisiblePoints(ProgramOwner& owner);

    void plan(PassPlan& plan) { rays_.plan(plan); }
    /// @param coordinates of voxels. @param requested of voxels: 0 if it was not visible before; becomes 1.
    /// @param newVoxels new ones are appended in any order. @param count its size.
    void mark(PassContext& context, const SurfaceVoxels& voxels, const Buffer& coordinates, const Buffer& requested,
              const Buffer& newVoxels, const Buffer& count) const;

 private:
    static constexpr uint32_t kPoints = 12;  ///< As in visible_points.glsl.

    VoxelPointRays rays_{kPoints};
    Kernel generateRays_, markVoxels_;
};

}  // namespace voxray
