#pragma once

#include "graph/pass.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/clusters/voxel_point_rays.h"
#include "passes/common/lights/light_sources.h"
#include "passes/surfels/surfel_points.h"

namespace voxray {

/// The paper's shadow test: a punctual light lights all surfels of a voxel, without shadows, if it sees one
/// of 18 points around the voxel. Source: Cosin and Patow 2022, section 4.4 and figure 10; docs/clusters.md
/// has our choices where the text leaves one.
class LitPoints {
 public:
    explicit LitPoints(ProgramOwner& owner);

    void plan(PassPlan& plan) { rays_.plan(plan); }
    /// Adds irradiance, W/m², to that of surfels in the order of VoxelPatches::surfelIds, 3 floats each.
    /// @param sources punctual.
    void measure(PassContext& context, const std::vector<LightSource>& sources, const SurfaceVoxels& voxels,
                 const VoxelClusters& clusters, const SurfelPoints& points, const VoxelPatches& patches,
                 const LargeBuffer& surfelIrradiance) const;

 private:
    static constexpr uint32_t kPoints = 18;  ///< As in lit_points.glsl.

    VoxelPointRays rays_{kPoints};
    Kernel generateRays_, addLight_;
};

}  // namespace voxray
