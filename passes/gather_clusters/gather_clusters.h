#pragma once

#include <array>
#include <optional>
#include <utility>

#include "graph/registry.h"
#include "passes/common/clusters/cluster_light.h"
#include "passes/common/clusters/voxel_clusters.h"
#include "passes/gather_clusters/seen_voxels.h"

namespace voxray {

/// What the filter averages over.
enum class FilterOver { All, Lit };
template <>
struct EnumNames<FilterOver> {
    static constexpr std::array names{std::pair{FilterOver::All, "all"}, std::pair{FilterOver::Lit, "lit"}};
};

/// Indirect light of voxels' faces out of the clusters that they see, filtered over neighbours. Source: Cosin
/// and Patow 2022, section 4.4.
class GatherClusters final : public Pass {
 public:
    static constexpr const char* kName = "gather_clusters";
    static constexpr const char* kHelp =
        "Gathers what each patch receives from the clusters that it sees (cluster_visibility, "
        "inject_clusters) and smooths it over neighbours that look into the same space. The result is "
        "irradiance of voxels, with the direct light that inject_clusters read or measured: "
        "gather_irradiance or gather_rays show it. Biased by: voxel and cluster size, the filter (light "
        "creeps round edges). Noisy by: the lists' rays. "
        "Source: Cosin and Patow 2022, section 4.4.";
    struct Params {
        GatherUpdate update = GatherUpdate::All;
        uint32_t reach = 4;
        uint32_t filterPasses = 1;
        uint32_t filterSize = 3;
        FilterOver filterOver = FilterOver::All;
        static constexpr auto schema() {
            return std::tuple{
                field("update", &Params::update,
                      "all: every voxel, whenever light or voxels have changed. seen: voxels round what the "
                      "camera sees, when they come into view; they keep their light until light or voxels "
                      "change. For gather_irradiance, which reads no others. seen_points: likewise, but "
                      "those that the camera sees one of 12 points 2 voxels round their centers (the "
                      "paper's); what the lookup reads of others is left out of its mean."),
                field(
                    "reach", &Params::reach,
                    "How many voxels along each axis count as round what the camera sees. It must be as far "
                    "as the lookup that follows reads: 4 times gather_irradiance's 'radius', where little "
                    "surface is near, and one more with 'lookup: seven_tap'. A lookup that reads farther is "
                    "refused.",
                    1u, 64u)
                    .onlyWith(oneOf(&Params::update, {GatherUpdate::Seen})),
                field("filter_passes", &Params::filterPasses,
                      "Times that faces are averaged with the same faces of the sides round them. The paper: "
                      "2, "
                      "of size 5.",
                      0u, 8u),
                field(
                    "filter_size", &Params::filterSize,
                    "Voxels along each edge of the filter's cube, with binomial weights (about a Gaussian). "
                    "Sides that something hides and faces without surfaces don't count.",
                    std::vector{3u, 5u})
                    .onlyWith(noneOf(&Params::filterPasses, {0u})),
                field(
                    "filter_over", &Params::filterOver,
                    "all: every face in the cube. lit: those that any light reaches, as in the paper; light "
                    "then spreads into what is dark and none of it is lost for that, so it grows.")
                    .onlyWith(noneOf(&Params::filterPasses, {0u}))};
        }
    };

    explicit GatherClusters(const Params& params) : params_(params), seen_(params.update) {}
    Phase phase() const override { return isLazy() ? Phase::Frame : Phase::Build; }
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    bool isLazy() const { return params_.update != GatherUpdate::All; }
    bool readsGBuffer() const { return params_.update == GatherUpdate::Seen; }
    /// Binomial weights of 5 voxels are those of 3, twice.
    uint32_t filterSteps() const { return params_.filterPasses * (params_.filterSize / 2); }
    /// Gathers and filters the light of voxels that were found.
    void gather(PassContext& context, const SeenVoxels::Found& found);

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const VoxelPatches> patches_;
    Port<const VoxelClusters> clusters_;
    Port<const ClusterVisibility> visibility_;
    Port<const ClusterLight> light_;
    Port<const GBuffer> gbuffer_;
    Port<VoxelIrradiance> irradiance_;
    SeenVoxels seen_;
    Program gather_, filter_, store_;
    LargeBuffer gathered_, filtered_;                       ///< Irradiance of patches.
    std::optional<std::pair<uint64_t, uint64_t>> version_;  ///< Of lists and light.
};

}  // namespace voxray
