#pragma once

#include "graph/pass.h"
#include "passes/clusters/point_rays.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/lights/light_sources.h"

namespace voxray {

/// Direct light of voxels that punctual lights see one of 18 points round: all of a voxel's surfels are lit,
/// or none. Source: Cosin and Patow 2022, section 4.4 and figure 10; docs/clusters.md tells what the text
/// leaves open.
class LitPoints {
 public:
    explicit LitPoints(ProgramOwner& owner);

    void plan(PassPlan& plan) { rays_.plan(plan); }
    /// Adds the irradiance, W/m², of the surfels of VoxelPatches to `surfels`, 3 floats each.
    /// @param sources punctual lights.
    void measure(PassContext& context, const std::vector<LightSource>& sources, const SurfaceVoxels& voxels,
                 const VoxelClusters& clusters, const VoxelPatches& patches,
                 const LargeBuffer& surfels) const;

 private:
    static constexpr uint32_t kPoints = 18;  ///< As in lit_points.glsl.

    PointRays rays_{kPoints};
    Kernel aim_, add_;
};

}  // namespace voxray
