#pragma once

#include "passes/common/surfels/surfel_links.h"
#include "passes/common/surfels/surfel_sort.h"
#include "passes/common/voxels/voxels.h"
#include "passes/link_surfels/neighbour_search.h"

namespace voxray {

/// Links surfels by rays, for inject_radiosity. Source: Goral et al. 1984 (radiosity); Lehtinen et al. 2008
/// (light transport between points); docs/radiosity.md.
class LinkSurfels final : public Pass {
 public:
    static constexpr const char* kName = "link_surfels";
    static constexpr const char* kHelp =
        "Finds by rays which surfels see each other, once for a geometry: light then travels along these "
        "links without rays (inject_radiosity). Biased by: surfels' distance (a hit takes the light of the "
        "nearest "
        "surfel in its voxel). Noisy by: rays_per_surfel. Source: Goral et al. 1984; Lehtinen et al. 2008.";
    struct Params {
        uint32_t raysPerSurfel = 64;
        static constexpr auto schema() {
            return std::tuple{field("rays_per_surfel", &Params::raysPerSurfel,
                                    "Rays from each surfel; 4 bytes each.", 1u, 4096u)
                                  .lessNoise()};
        }
    };

    explicit LinkSurfels(const Params& params) : params_(params) {}
    void declare(PassBuilder& builder) override;
    void plan(PassPlan& plan) override;
    void prepare(PassSetup& setup) override;
    void record(PassContext& context) override;

 private:
    /// Traces the rays of a chunk, whose first surfel has number `first`, and links them. `inverseDistances`
    /// gets, by slot, the mean of 1 / distance of what each surfel sees, 1 / voxel.
    void link(PassContext& context, const Surfels::Chunk& chunk, uint32_t first, SurfelLinks& links,
              const LargeBuffer& inverseDistances) const;

    /// Packs means of these with the surfels.
    void packDistance(PassContext& context, const LargeBuffer& inverseDistances) const;

    /// What lookups read of the surfels that are sorted by voxel.
    void pack(PassContext& context) const;

    Params params_;
    Port<const SurfaceVoxels> voxels_;
    Port<const Surfels> surfels_;
    Port<SurfelLinks> links_;
    Port<SurfelsByVoxel> byVoxel_;
    Port<SurfelNeighbours> neighbours_;
    SurfelSort sort_;
    NeighbourSearch neighbourSearch_;
    Program pack_, emit_, probe_, link_, distance_, packDistance_;
    Buffer rays_, hits_, probes_, covered_, unlinked_;  ///< Scratch, of a batch of rays.
};

}  // namespace voxray
