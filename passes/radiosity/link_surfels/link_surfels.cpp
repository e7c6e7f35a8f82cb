#include <algorithm>
#include <limits>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/voxels/voxels.h"
#include "passes/radiosity/link_surfels/neighbor_search.h"
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
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Links the surfels that see each other, for radiosity. "
        "Rays find the links once for a geometry; light then travels along them (inject_radiosity). "
        "Biased by: the distance of surfels (a hit takes the light of the nearest surfel in its voxel). "
        "Noisy by: rays_per_surfel. Source: Goral et al. 1984; Lehtinen et al. 2008.";
    struct Params {
        uint32_t raysPerSurfel = 64;
        static constexpr auto schema() {
            return std::tuple{
                field("rays_per_surfel", &Params::raysPerSurfel, "Rays from each surfel; 4 bytes each.", 1u, 4096u)
                    .lessNoise()};
        }
    };

    explicit LinkSurfels(const Params& params) : params_(params) {}
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    void packSurfels(PassContext& context) const;
    /// Traces the rays of a chunk and links their hits. @param inverseDistances by sorted surfel, means over
    /// its rays, 1/voxel.
    void linkHits(PassContext& context, const Surfels::Chunk& chunk, SurfelLinks& links,
                  const LargeBuffer& inverseDistances) const;
    void packMeanDistances(PassContext& context, const LargeBuffer& inverseDistances) const;

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels, by which surfels are found"};
    In<Surfels> surfels_{*this, "surfels", "points to link"};
    Out<SurfelLinks> links_{*this, "links", "which surfels each surfel sees"};
    Out<SurfelsByVoxel> byVoxel_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    Out<SurfelNeighbors> neighbors_{*this, "neighbors", "the surfels around each surfel"};
    SurfelSort sort_{*this};
    NeighborSearch neighborSearch_{*this};
    Kernel packSurfels_{*this, "pack_surfels.comp"};
    Kernel generateRays_{*this, "generate_rays.comp"};
    Kernel generateOcclusionRays_{*this, "passes/surfels/generate_occlusion_rays.comp"};
    Kernel linkHits_{*this, "link_hits.comp"};
    Kernel meanInverseDistance_{*this, "mean_inverse_distance.comp"};
    Kernel packMeanDistances_{*this, "pack_mean_distances.comp"};
    Buffer rays_, hits_, occlusionRays_, occluded_, unlinkedHits_;  ///< Scratch, of a batch of rays.
};

void LinkSurfels::plan(PassPlan& plan) {
    plan[links_].raysPerSurfel = params_.raysPerSurfel;
    plan.estimate(plan[surfels_].estimatedCount *
                  (params_.raysPerSurfel * sizeof(uint32_t) + sizeof(gpu::SortedSurfel)));
    plan.scratchBuffer(rays_, "link rays", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(hits_, "link hits", uint64_t(kBatchRays) * sizeof(Hit));
    plan.scratchBuffer(occlusionRays_, "occlusion rays of link hits", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(occluded_, "occluded link hits", uint64_t(kBatchRays) * sizeof(uint32_t));
    plan.scratchBuffer(unlinkedHits_, "number of hits without surfel", sizeof(uint32_t));
    plan[byVoxel_].hasOccludedSurfels = plan[surfels_].hasOccludedSurfels;
}

void LinkSurfels::record(PassContext& context) {
    if (!context.inputsChanged()) return;  // Only light has changed.
    SurfelLinks& links = context[links_];
    const Surfels& surfels = context[surfels_];
    const uint64_t count = surfels.count;
    if (count * params_.raysPerSurfel >= std::numeric_limits<uint32_t>::max())
        throw Error(
            "{}: {} surfels with {} rays each are more links than can be numbered (2^32); "
            "lower 'rays_per_surfel', or place_surfels's 'points_per_voxel'",
            kName, count, params_.raysPerSurfel);
    links.surfelCount = uint32_t(count);
    ensureSize(links.links, context.device, "surfel links", count * params_.raysPerSurfel * sizeof(uint32_t));

    sort_.run(context.stream, surfels, context[voxels_].voxelCount, context[byVoxel_]);
    packSurfels(context);
    const LargeBuffer inverseDistances(context.device, "inverse distances of surfels",
                                       std::max(context[byVoxel_].sortedCount, 1u) * sizeof(float));
    context.stream.fill(unlinkedHits_, 0);
    for (const Surfels::Chunk& chunk : surfels.chunks) linkHits(context, chunk, links, inverseDistances);
    packMeanDistances(context, inverseDistances);
    if (context[neighbors_].isRead)
        context.report("radius of neighbors, voxels",
                       neighborSearch_.run(context.stream, context[voxels_], surfels.pointCount, context[byVoxel_],
                                           context[neighbors_]));
    const uint32_t unlinkedHits = context.stream.readAs<uint32_t>(unlinkedHits_, 1)[0];
    context.report("links", double(count) * params_.raysPerSurfel);
    context.report("hits without surfel, % of rays", 100.0 * unlinkedHits / (double(count) * params_.raysPerSurfel));
}

void LinkSurfels::packSurfels(PassContext& context) const {
    const SurfaceVoxels& voxels = context[voxels_];
    SurfelsByVoxel& byVoxel = context[byVoxel_];
    ensureSize(byVoxel.packed, context.device, "packed surfels",
               std::max(byVoxel.sortedCount, 1u) * kPackedSurfelBytes);
    context.dispatch(packSurfels_, voxels.voxelCount,
                     {voxels,
                      {"SortedRef", byVoxel.sorted.ref()},
                      {"PackedRef", byVoxel.packed.ref()},
                      {"surfelRanges", byVoxel.ranges},
                      {"voxels", voxels.voxelCount}});
}

void LinkSurfels::linkHits(PassContext& context, const Surfels::Chunk& chunk, SurfelLinks& links,
                           const LargeBuffer& inverseDistances) const {
    const SurfaceVoxels& voxels = context[voxels_];
    const SurfelsByVoxel& byVoxel = context[byVoxel_];
    const bool testsOcclusion = context[surfels_].hasOccludedSurfels;
    if (!testsOcclusion) context.stream.fill(occluded_, 0);
    const uint32_t raysPerSurfel = params_.raysPerSurfel, surfelsPerBatch = kBatchRays / raysPerSurfel;
    for (uint32_t firstInChunk = 0; firstInChunk < chunk.count; firstInChunk += surfelsPerBatch) {
        const uint32_t surfels = std::min(surfelsPerBatch, chunk.count - firstInChunk), rays = surfels * raysPerSurfel;
        context.dispatch(generateRays_, rays,
                         {{"surfels", chunk.surfels},
                          {"rays", rays_},
                          {"firstSurfel", firstInChunk},
                          {"rayCount", rays},
                          {"raysPerSurfel", raysPerSurfel},
                          {"seed", randomSeed(context.frame)}});
        context.tracer.closestHit(context.stream, rays_, hits_, rays);
        if (testsOcclusion) {
            context.dispatch(generateOcclusionRays_, rays,
                             {context.scene,
                              {"rays", rays_},
                              {"hits", hits_},
                              {"occlusionRays", occlusionRays_},
                              {"rayCount", rays},
                              {"voxelSize", voxels.grid.voxelSize}});
            context.tracer.occluded(context.stream, occlusionRays_, occluded_, rays);
        }
        context.dispatch(linkHits_, rays,
                         {context.scene,
                          voxels,
                          {"rays", rays_},
                          {"hits", hits_},
                          {"occluded", occluded_},
                          {"SortedRef", byVoxel.sorted.ref()},
                          {"surfelRanges", byVoxel.ranges},
                          {"LinksRef", links.links.ref()},
                          {"unlinkedHits", unlinkedHits_},
                          {"firstSurfel", chunk.firstIndex + firstInChunk},
                          {"rayCount", rays},
                          {"raysPerSurfel", raysPerSurfel},
                          {"surfelCount", links.surfelCount}});
        context.dispatch(meanInverseDistance_, surfels,
                         {{"hits", hits_},
                          {"SortedIndicesRef", byVoxel.sortedIndices.ref()},
                          {"InverseDistancesRef", inverseDistances.ref()},
                          {"firstSurfel", chunk.firstIndex + firstInChunk},
                          {"surfelCount", surfels},
                          {"raysPerSurfel", raysPerSurfel},
                          {"voxelSize", voxels.grid.voxelSize}});
    }
    context.stream.finish();
}

void LinkSurfels::packMeanDistances(PassContext& context, const LargeBuffer& inverseDistances) const {
    const SurfelsByVoxel& byVoxel = context[byVoxel_];
    const uint32_t voxels = context[voxels_].voxelCount;
    context.dispatch(packMeanDistances_, voxels,
                     {{"InverseDistancesRef", inverseDistances.ref()},
                      {"PackedRef", byVoxel.packed.ref()},
                      {"surfelRanges", byVoxel.ranges},
                      {"voxels", voxels}});
    context.stream.finish();
}

VOXRAY_REGISTER_PASS(LinkSurfels);

}  // namespace voxray
