#include <algorithm>
#include <limits>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/voxels/voxels.h"
#include "passes/radiosity/link_surfels/neighbour_search.h"
#include "passes/surfels/surfel_links.h"
#include "passes/surfels/surfel_sort.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;
constexpr uint64_t kPackedSurfelBytes = 2 * sizeof(uint32_t);

}  // namespace

/// Links surfels by rays, for inject_radiosity. Source: Goral et al. 1984 (radiosity); Lehtinen et al. 2008
/// (light transport between points); docs/radiosity.md.
class LinkSurfels final : public Pass {
 public:
    static constexpr const char* kName = "link_surfels";
    static constexpr const char* kHelp =
        "Links the surfels that see each other, for radiosity. Finds the links by rays, once for a geometry. "
        "Light then travels along them without rays (inject_radiosity). Biased by: surfels' distance (a hit "
        "takes the light of the nearest surfel in its voxel). Noisy by: rays_per_surfel. Source: Goral et "
        "al. 1984; Lehtinen et al. 2008.";
    struct Params {
        uint32_t raysPerSurfel = 64;
        static constexpr auto schema() {
            return std::tuple{field("rays_per_surfel", &Params::raysPerSurfel,
                                    "Rays from each surfel; 4 bytes each.", 1u, 4096u)
                                  .lessNoise()};
        }
    };

    explicit LinkSurfels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
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

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels, by which surfels are found"};
    In<Surfels> surfels_{*this, "surfels", "points to link"};
    Out<SurfelLinks> links_{*this, "links", "which surfels each surfel sees"};
    Out<SurfelsByVoxel> byVoxel_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    Out<SurfelNeighbours> neighbours_{*this, "neighbours", "the surfels around each surfel"};
    SurfelSort sort_{*this};
    NeighbourSearch neighbourSearch_{*this};
    Kernel pack_{*this, "pack.comp"};
    Kernel emit_{*this, "emit.comp"};
    Kernel probe_{*this, "probe.comp"};
    Kernel link_{*this, "link.comp"};
    Kernel distance_{*this, "inverse_distance.comp"};
    Kernel packDistance_{*this, "pack_distance.comp"};
    Buffer rays_, hits_, probes_, covered_, unlinked_;  ///< Scratch, of a batch of rays.
};

void LinkSurfels::plan(PassPlan& plan) {
    plan[links_].raysPerSurfel = params_.raysPerSurfel;
    plan.estimate(plan[surfels_].estimatedCount *
                  (params_.raysPerSurfel * sizeof(uint32_t) + sizeof(gpu::SortedSurfel)));
    plan.scratchBuffer(rays_, "link rays", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(hits_, "link hits", uint64_t(kBatchRays) * sizeof(Hit));
    plan.scratchBuffer(probes_, "rays that tell covered hits", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(covered_, "link hits on covered sides", uint64_t(kBatchRays) * sizeof(uint32_t));
    plan.scratchBuffer(unlinked_, "number of hits without surfel", sizeof(uint32_t));
    plan[byVoxel_].coveredSides = plan[surfels_].coveredSides;
}

void LinkSurfels::record(PassContext& context) {
    if (!context.inputsChanged()) return;  // Light alone has changed.
    SurfelLinks& links = context[links_];
    const Surfels& surfels = context[surfels_];
    const uint64_t count = surfels.count;
    if (count * params_.raysPerSurfel >= std::numeric_limits<uint32_t>::max())
        throw Error(
            "{}: {} surfels with {} rays each are more links than can be numbered (2^32); lower "
            "'rays_per_surfel', or place_surfels's 'points_per_voxel'",
            kName, count, params_.raysPerSurfel);
    links.surfelCount = uint32_t(count);
    makeOrKeep(links.links, context.device, "surfel links", count * params_.raysPerSurfel * sizeof(uint32_t));

    sort_.run(context.stream, surfels, context[voxels_].voxelCount, context[byVoxel_]);
    pack(context);
    const LargeBuffer inverseDistances(context.device, "inverse distances of surfels",
                                       std::max(context[byVoxel_].slotCount, 1u) * sizeof(float));
    context.stream.fill(unlinked_, 0);
    uint32_t first = 0;
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        link(context, chunk, first, links, inverseDistances);
        first += chunk.count;
    }
    packDistance(context, inverseDistances);
    if (context[neighbours_].isRead)
        context.report("radius of neighbours, voxels",
                       neighbourSearch_.run(context.stream, context[voxels_], surfels.pointCount,
                                            context[byVoxel_], context[neighbours_]));
    const uint32_t unlinked = context.stream.readAs<uint32_t>(unlinked_, 1)[0];
    context.report("links", double(count) * params_.raysPerSurfel);
    context.report("hits without surfel, % of rays",
                   100.0 * unlinked / (double(count) * params_.raysPerSurfel));
}

void LinkSurfels::pack(PassContext& context) const {
    const SurfaceVoxels& voxels = context[voxels_];
    SurfelsByVoxel& byVoxel = context[byVoxel_];
    makeOrKeep(byVoxel.packed, context.device, "packed surfels",
               std::max(byVoxel.slotCount, 1u) * kPackedSurfelBytes);
    context.dispatch(pack_, voxels.voxelCount,
                     {voxels,
                      {"SortedAt", byVoxel.sorted.at()},
                      {"PackedAt", byVoxel.packed.at()},
                      {"lists", byVoxel.lists},
                      {"voxels", voxels.voxelCount}});
}

void LinkSurfels::link(PassContext& context, const Surfels::Chunk& chunk, uint32_t first, SurfelLinks& links,
                       const LargeBuffer& inverseDistances) const {
    const SurfaceVoxels& voxels = context[voxels_];
    const SurfelsByVoxel& byVoxel = context[byVoxel_];
    const bool probe = context[surfels_].coveredSides;
    if (!probe) context.stream.fill(covered_, 0);
    const uint32_t perSurfel = params_.raysPerSurfel, batch = kBatchRays / perSurfel;
    for (uint32_t begin = 0; begin < chunk.count; begin += batch) {
        const uint32_t surfels = std::min(batch, chunk.count - begin), rays = surfels * perSurfel;
        context.dispatch(emit_, rays,
                         {{"surfels", chunk.surfels},
                          {"rays", rays_},
                          {"firstSurfel", begin},
                          {"rayCount", rays},
                          {"raysPerSurfel", perSurfel},
                          {"seed", randomSeed(context.frame)}});
        context.tracer.closestHit(context.stream, rays_, hits_, rays);
        if (probe) {
            context.dispatch(probe_, rays,
                             {context.scene,
                              {"rays", rays_},
                              {"hits", hits_},
                              {"probes", probes_},
                              {"rayCount", rays},
                              {"voxelSize", voxels.grid.voxelSize}});
            context.tracer.occluded(context.stream, probes_, covered_, rays);
        }
        context.dispatch(link_, rays,
                         {context.scene,
                          voxels,
                          {"rays", rays_},
                          {"hits", hits_},
                          {"covered", covered_},
                          {"SortedAt", byVoxel.sorted.at()},
                          {"lists", byVoxel.lists},
                          {"LinksAt", links.links.at()},
                          {"unlinked", unlinked_},
                          {"firstNumber", first + begin},
                          {"rayCount", rays},
                          {"raysPerSurfel", perSurfel},
                          {"surfelCount", links.surfelCount}});
        context.dispatch(distance_, surfels,
                         {{"hits", hits_},
                          {"SlotsAt", byVoxel.slots.at()},
                          {"InverseDistancesAt", inverseDistances.at()},
                          {"firstNumber", first + begin},
                          {"surfelCount", surfels},
                          {"raysPerSurfel", perSurfel},
                          {"voxelSize", voxels.grid.voxelSize}});
    }
    context.stream.finish();
}

void LinkSurfels::packDistance(PassContext& context, const LargeBuffer& inverseDistances) const {
    const SurfelsByVoxel& byVoxel = context[byVoxel_];
    const uint32_t voxels = context[voxels_].voxelCount;
    context.dispatch(packDistance_, voxels,
                     {{"InverseDistancesAt", inverseDistances.at()},
                      {"PackedAt", byVoxel.packed.at()},
                      {"lists", byVoxel.lists},
                      {"voxels", voxels}});
    context.stream.finish();
}

VOXRAY_REGISTER_PASS(LinkSurfels);

}  // namespace voxray
