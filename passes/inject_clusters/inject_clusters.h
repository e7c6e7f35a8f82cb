#pragma once

#include <optional>
#include <tuple>

#include "graph/registry.h"
#include "passes/common/clusters/cluster_light.h"

namespace voxray {

/// Light of voxels, summed up to what their clusters send, and bounced from face to face by the lists of what
/// faces see. Source: Cosin and Patow 2022, section 4.4.
class InjectClusters final : public Pass {
 public:
    static constexpr const char* kName = "inject_clusters";
    static constexpr const char* kHelp =
        "Sums the light of lit voxels, whichever pass injected it, up to their clusters: what each cluster "
        "sends from each of its six faces. With bounces, light goes on from cluster to face and on, by the "
        "lists of cluster_visibility. Biased by: the size of clusters, over which light is averaged. "
        "Source: Cosin and Patow 2022, section 4.4.";
    struct Params {
        uint32_t bounces = 0;
        static constexpr auto schema() {
            return std::tuple{
                field("bounces", &Params::bounces,
                      "Bounces between clusters, after those of the injection and before the one "
                      "of gather_clusters.",
                      0u, 64u)};
        }
    };

    explicit InjectClusters(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// What is sent of the injected light and of what has bounced so far.
    void reflect(PassContext& context, bool hasBounced);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelIrradiance> irradiance_;
    Port<const VoxelClusters> clusters_;
    Port<const ClusterVisibility> visibility_;
    Port<ClusterLight> light_;
    ClusterGather gather_;
    Program reflectVoxels_, sumClusters_;
    LargeBuffer bounced_;
    std::optional<std::tuple<uint64_t, uint64_t, uint64_t>> version_;  ///< Of voxels, lists and light.
};

}  // namespace voxray
