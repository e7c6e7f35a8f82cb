#pragma once

#include "passes/clusters/voxel_point_rays.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Voxels that count as seen because the camera sees one of 12 points around them. Source: Cosin and Patow
/// 2022, section 4.4; docs/clusters.md has our choices where the text leaves one.
class VisiblePoints {
 public:
    explicit VisiblePoints(ProgramOwner& owner);

    void plan(PassPlan& plan) { rays_.plan(plan); }
    /// @param coordinates by voxel. @param requested by voxel: 0 where it was not seen before; becomes 1.
    /// @param newVoxels those that are new, in any order, behind the `count` that are there.
    void mark(PassContext& context, const SurfaceVoxels& voxels, const Buffer& coordinates,
              const Buffer& requested, const Buffer& newVoxels, const Buffer& count) const;

 private:
    static constexpr uint32_t kPoints = 12;  ///< As in visible_points.glsl.

    VoxelPointRays rays_{kPoints};
    Kernel generateRays_, markVoxels_;
};

}  // namespace voxray
