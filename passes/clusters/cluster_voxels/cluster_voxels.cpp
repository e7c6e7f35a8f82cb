#include <optional>

#include "graph/registry.h"
#include "passes/clusters/cluster_voxels/cluster_list.h"
#include "passes/clusters/cluster_voxels/fragment_angle_sums.h"
#include "passes/clusters/cluster_voxels/slic_clustering.h"
#include "passes/clusters/voxel_clusters.h"

namespace voxray {

/// Groups adjacent surface voxels of similar normals into clusters, as SLIC groups pixels into superpixels.
/// Source: Cosin and Patow 2022, section 4.2; Achanta et al. 2012 (SLIC).
class ClusterVoxels final : public Pass {
 public:
    static constexpr const char* kName = "cluster_voxels";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Groups surface voxels into clusters by position and normal. "
        "Light is gathered from clusters instead of their voxels (cluster_visibility, inject_clusters, "
        "gather_clusters). Seeds start on a uniform grid. In each iteration voxels join a seed of similar normal; "
        "then seeds move to the mean of their voxels. "
        "Biased by: the size of clusters, over which light is averaged. No noise: the same clusters in each run. "
        "Source: Cosin and Patow 2022, section 4.2; Achanta et al. 2012 (SLIC).";
    using Params = ClusterParams;

    explicit ClusterVoxels(const Params& params) : params_(params) {
        if (params.usesFragments()) fragmentAngleSums_.emplace(*this);
    }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    Out<VoxelClusters> clusters_{*this, "clusters", "clusters of surface voxels"};
    std::optional<FragmentAngleSums>
        fragmentAngleSums_;  ///< For `ties: fragments`, which breaks ties between least occupied directions.
    SlicClustering clustering_{*this, params_};
    ClusterList list_{*this};
    Kernel listVoxels_{*this, "passes/common/voxels/list_voxels.comp"};
};

void ClusterVoxels::plan(PassPlan& plan) {
    if (fragmentAngleSums_) fragmentAngleSums_->plan(plan);
}

void ClusterVoxels::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelClusters& clusters = context[clusters_];
    CommandStream& stream = context.stream;
    clusters.clusters = {}, clusters.clusterOfVoxel = {}, clusters.coordinates = {};
    clusters.coordinates = Buffer(context.device, "coordinates of voxels", voxels.voxelCount * sizeof(glm::uvec3));
    const uint32_t words = uint32_t(voxels.words());
    context.dispatch(listVoxels_, words, {voxels, {"voxelCoordinates", clusters.coordinates}, {"words", words}});
    FragmentAngleSums::Sums angleSums;
    if (fragmentAngleSums_) angleSums = fragmentAngleSums_->measure(context, voxels);
    const SlicClustering::Result slic = clustering_.run(stream, voxels, clusters.coordinates, angleSums);
    list_.build(stream, voxels.voxelCount, slic, clusters);
    context.report("clusters", clusters.count);
    context.report("clusters, % of voxels", 100.0 * clusters.count / voxels.voxelCount);
    context.report("voxels that no seed reached, %", 100.0 * slic.unassignedCount / voxels.voxelCount);
    if (params_.normals == ClusterNormals::AreaWeighted) return;
    const SlicClustering::NormalCounts& counts = slic.normalCounts;
    const auto reportPercent = [&](const char* name, uint32_t count) {
        context.report(name, 100.0 * count / voxels.voxelCount);
    };
    // Surfaces disagree if the normals in the voxel differ too much for a mean
    reportPercent("voxels whose surfaces disagree, %", counts.disagreeing);
    reportPercent("voxels with a tie for the least occupied direction, %", counts.tied);
    reportPercent("voxels where fragments break the tie otherwise than the area-weighted normal, %",
                  counts.decidedByFragments);
    reportPercent("voxels whose normal differs from the area-weighted one, %", counts.changed);
}

VOXRAY_REGISTER_PASS(ClusterVoxels);

}  // namespace voxray
