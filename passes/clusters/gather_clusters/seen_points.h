#pragma once

#include "passes/clusters/point_rays.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Voxels that the camera sees one of 12 points round. Source: Cosin and Patow 2022, section 4.4;
/// docs/clusters.md tells what the text leaves open.
class SeenPoints {
 public:
    explicit SeenPoints(ProgramOwner& owner);

    void plan(PassPlan& plan) { rays_.plan(plan); }
    /// @param coordinates of voxels. @param asked by voxel: 0 where it was not seen before; becomes 1.
    /// @param found numbers of those that are new, in any order, after the `count` that are there.
    void mark(PassContext& context, const SurfaceVoxels& voxels, const Buffer& coordinates,
              const Buffer& asked, const Buffer& found, const Buffer& count) const;

 private:
    static constexpr uint32_t kPoints = 12;  ///< As in seen_points.glsl.

    PointRays rays_{kPoints};
    Kernel aim_, mark_;
};

}  // namespace voxray
