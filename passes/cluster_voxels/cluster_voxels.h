#pragma once

#include <array>
#include <optional>
#include <utility>

#include "graph/registry.h"
#include "passes/cluster_voxels/cluster_growth.h"
#include "passes/cluster_voxels/cluster_list.h"
#include "passes/common/clusters/voxel_clusters.h"

namespace voxray {

/// Groups surface voxels that lie near each other and look the same way, as a segmentation of images groups
/// pixels. Source: Cosin and Patow 2022, section 4.2; Achanta et al. 2012 (SLIC).
class ClusterVoxels final : public Pass {
 public:
    static constexpr const char* kName = "cluster_voxels";
    static constexpr const char* kHelp =
        "Groups surface voxels by place and normal into clusters, which stand for their voxels where light "
        "is "
        "gathered (cluster_visibility, inject_clusters, gather_clusters). Seeds in a uniform grid take the "
        "voxels round them that look their way; centers and normals follow, some times over. "
        "Biased by: the size of clusters, over which light is averaged. No noise: the same clusters in each "
        "run. Source: Cosin and Patow 2022, section 4.2; Achanta et al. 2012 (SLIC).";
    using Params = ClusterParams;

    explicit ClusterVoxels(const Params& params) : params_(params), growth_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<VoxelClusters> clusters_;
    FragmentAngles fragments_;
    ClusterGrowth growth_;
    ClusterList list_;
    Program coordinates_;
    std::optional<uint64_t> version_;  ///< Of the voxels.
};

}  // namespace voxray
