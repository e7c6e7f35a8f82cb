#pragma once

#include <optional>
#include <utility>

#include "graph/registry.h"
#include "passes/common/clusters/voxel_clusters.h"
#include "passes/common/clusters/voxel_patches.h"
#include "passes/common/surfels/surfel_sort.h"
#include "passes/find_patches/kept_sides.h"
#include "passes/find_patches/part_search.h"
#include "passes/find_patches/side_search.h"

namespace voxray {

/// Splits the surfaces of each voxel by the space that they look into, and clusters likewise, so that
/// no side of a thin wall holds the other side's light. Beyond Cosin and Patow 2022; docs/clusters.md.
class FindPatches final : public Pass {
 public:
    static constexpr const char* kName = "find_patches";
    static constexpr const char* kHelp =
        "Splits the surfels of each voxel into sides, those between which nothing stands, and clusters into "
        "parts that hang together: so both sides of a wall that is thinner than a voxel are told apart where "
        "light is gathered (cluster_visibility, inject_clusters, gather_clusters). With place_surfels' "
        "'sides: all' gaps narrower than a voxel have sides, too, which send light and receive it. Biased "
        "by: "
        "voxel size "
        "(what hides less than half a voxel above surfaces splits nothing). Noisy by: points_per_voxel (a "
        "surface without a point has no side). Source: docs/clusters.md.";
    struct Params {
        static constexpr auto schema() { return std::tuple{}; }
    };

    explicit FindPatches(const Params&) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// The side of its voxel that each surfel is on.
    void findSides(PassContext& context, SurfelsByVoxel& lists);
    void listSides(PassContext& context, const SurfelsByVoxel& lists);
    /// Sides next to each other that nothing hides.
    void findNeighbours(PassContext& context);

    bool isUpdate() const { return kept_ && kept_->isActive(); }

    Port<const SurfaceVoxels> voxels_;
    Port<const Surfels> surfels_;
    Port<const VoxelClusters> clusters_;
    Port<VoxelPatches> patches_;
    SurfelSort sort_;
    std::optional<PrefixSum> prefixSum_;
    std::optional<SideSearch> sideSearch_;
    std::optional<PartSearch> partSearch_;
    std::optional<KeptSides> kept_;  ///< Where surfaces move.
    Program beginKept_, aimNearKept_, partNearKept_;
    Program begin_, order_, list_, describe_, numberPatches_;
    Program countNear_, listNear_, aimNear_, partNear_;
    RayBatch batch_;                                        ///< Scratch.
    std::optional<std::pair<uint64_t, uint64_t>> version_;  ///< Of the voxels and their clusters.
};

}  // namespace voxray
