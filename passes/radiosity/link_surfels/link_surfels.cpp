#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/common/compute/changed_boxes.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/voxels/voxels.h"
#include "passes/radiosity/link_surfels/mean_distances.h"
#include "passes/radiosity/link_surfels/neighbor_search.h"
#include "passes/radiosity/link_surfels/waiting_links.h"
#include "passes/surfels/surfel_links.h"
#include "passes/surfels/surfel_sort.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;
constexpr uint64_t kPackedSurfelBytes = 2 * sizeof(uint32_t);

/// Distance in voxels up to which a change may affect the surfel of a hit: that lies in the voxel of the hit or an
/// adjacent one, and whether it exists depends on surfaces less than a voxel before it.
constexpr float kHitReach = 3.1f;

constexpr uint32_t kSurfelGroup = 128;  ///< SURFEL_GROUP of list_changed_links.comp.
constexpr uint32_t kHitBlock = 16;      ///< LINK_HIT_BLOCK of link_hit.glsl.

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
        "Where surfaces move, rays that pass or end near them are traced again. "
        "Biased by: the distance of surfels (a hit takes the light of the nearest surfel in its voxel); "
        "with an update_budget, links that wait show what their rays hit before. "
        "Noisy by: rays_per_surfel. Source: Goral et al. 1984; Lehtinen et al. 2008.";
    struct Params {
        uint32_t raysPerSurfel = 64;
        float updateBudget = 0;
        static constexpr auto schema() {
            return std::tuple{
                field("rays_per_surfel", &Params::raysPerSurfel, "Rays from each surfel; 4 bytes each.", 1u, 4096u)
                    .lessNoise(),
                field("update_budget", &Params::updateBudget,
                      "Most rays in a frame in which surfaces move, for each pixel of the image: links that changes "
                      "affect wait for theirs, and those that have waited longest come first. 0: no limit.",
                      0.0f, 64.0f)};
        }
    };

    explicit LinkSurfels(const Params& params) : params_(params) {
        if (params.updateBudget > 0) waiting_.emplace(*this);
    }
    bool buildReadsView() const override { return params_.updateBudget > 0; }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Surfels [first, first + count) of a chunk, whose rays are traced together.
    struct Batch {
        const Surfels::Chunk& chunk;
        uint32_t first = 0, count = 0;
        uint32_t firstIndex() const { return chunk.firstIndex + first; }
    };

    /// Whether links of the frame before are kept, but for those that a change may affect.
    bool canUpdate(PassContext& context) const;
    void packSurfels(PassContext& context) const;
    /// Traces rays of a batch and links their hits. @return the number of rays.
    uint32_t link(PassContext& context, const Batch& batch, bool isUpdate);
    /// Generates all rays of a batch. @return their number.
    uint32_t generateRays(PassContext& context, const Batch& batch) const;
    /// Generates the rays of a batch that a change may affect, and lists them. @return their number.
    uint32_t listChangedRays(PassContext& context, const Batch& batch);
    /// Dispatches listChangedLinks_.
    void findChanged(PassContext& context, const Batch& batch);
    /// Traces all links, or all that a change may affect. @return the number of rays.
    uint64_t linkAll(PassContext& context, bool isUpdate);
    /// Traces links that wait, within the budget; before, those that a change may affect join them. @return the number
    /// of rays.
    uint64_t linkWaiting(PassContext& context, bool hasChanged);
    void traceOcclusion(PassContext& context, uint32_t rays);
    void linkHits(PassContext& context, uint32_t firstSurfel, uint32_t rays, bool isUpdate);
    void findNeighbors(PassContext& context, bool isUpdate);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels, by which surfels are found"};
    In<Surfels> surfels_{*this, "surfels", "points to link"};
    Out<SurfelLinks> links_{*this, "links", "which surfels each surfel sees"};
    Out<SurfelsByVoxel> byVoxel_{*this, "surfels_by_voxel", "the surfels of each voxel"};
    Out<SurfelNeighbors> neighbors_{*this, "neighbors", "the surfels around each surfel"};
    SurfelSort sort_{*this};
    MeanDistances meanDistances_{*this};
    NeighborSearch neighborSearch_{*this};
    Kernel packSurfels_{*this, "pack_surfels.comp"};
    Kernel generateRays_{*this, "generate_rays.comp"};
    Kernel generateOcclusionRays_{*this, "passes/surfels/generate_occlusion_rays.comp"};
    Kernel linkHits_{*this, "link_hits.comp"};
    Kernel linkFarHits_{*this, "link_hits.comp", {{"ADJACENT", "1"}}};
    Kernel listChangedLinks_{*this, "list_changed_links.comp"};
    std::optional<WaitingLinks> waiting_;                           ///< With a budget.
    bool keepsHits_ = false;                                        ///< Surfaces move.
    LargeBuffer keptHits_;                                          ///< By link (link_hit.glsl), if hits are kept.
    Buffer boxes_;                                                  ///< Of changes, during an update.
    Buffer rays_, hits_, occlusionRays_, occluded_, unlinkedHits_;  ///< Scratch, of a batch of rays.
    Buffer farRays_, farCount_;                                     ///< Scratch: rays left to linkFarHits_.
    Buffer listedRays_, listedCount_;                               ///< Likewise, if hits are kept.
};

void LinkSurfels::plan(PassPlan& plan) {
    const Surfels& surfels = plan[surfels_];
    keepsHits_ = surfels.areIndexedById;
    plan[links_].raysPerSurfel = params_.raysPerSurfel;
    const double linkBytes = keepsHits_ ? 2 * sizeof(uint32_t) : sizeof(uint32_t);
    plan.estimate(surfels.estimatedCount * (params_.raysPerSurfel * linkBytes + sizeof(gpu::SortedSurfel)));
    plan.scratchBuffer(rays_, "link rays", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(hits_, "link hits", uint64_t(kBatchRays) * sizeof(Hit));
    plan.scratchBuffer(occlusionRays_, "occlusion rays of link hits", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(occluded_, "occluded link hits", uint64_t(kBatchRays) * sizeof(uint32_t));
    plan.scratchBuffer(unlinkedHits_, "number of hits without surfel", sizeof(uint32_t));
    plan.scratchBuffer(farRays_, "rays with no surfel close to their hit", uint64_t(kBatchRays) * sizeof(uint32_t));
    plan.scratchBuffer(farCount_, "number of rays with no surfel close to their hit", sizeof(uint32_t));
    plan[byVoxel_].hasOccludedSurfels = surfels.hasOccludedSurfels;
    meanDistances_.plan(keepsHits_, params_.raysPerSurfel);
    neighborSearch_.plan(plan[neighbors_], keepsHits_);
    listChangedLinks_.compileIf(keepsHits_);
    if (!keepsHits_) return;
    for (Kernel* kernel : {&linkHits_, &linkFarHits_}) kernel->define({{"KEEPS_HITS", "1"}});
    if (waiting_) {
        plan.estimate(surfels.estimatedCount * waiting_->plan(plan, params_.raysPerSurfel));
        listChangedLinks_.define({{"WAIT", "1"}});
    }
    plan.scratchBuffer(listedRays_, "listed link rays", uint64_t(kBatchRays) * sizeof(uint32_t));
    plan.scratchBuffer(listedCount_, "number of listed link rays", sizeof(uint32_t));
}

bool LinkSurfels::canUpdate(PassContext& context) const {
    const std::optional<std::vector<Box>>& changed = context.frame.changedRegions;
    return keepsHits_ && !context.isFirstRun() && changed && !changed->empty() && context[surfels_].keepPoints;
}

void LinkSurfels::record(PassContext& context) {
    const bool hasChanged = context.changed(voxels_) || context.changed(surfels_);
    if (!hasChanged && !(waiting_ && waiting_->waiting() > 0)) return context.markOutputsUnchanged();
    SurfelLinks& links = context[links_];
    const Surfels& surfels = context[surfels_];
    const uint64_t count = surfels.count;
    if (count * params_.raysPerSurfel > std::numeric_limits<uint32_t>::max() - kHitBlock * params_.raysPerSurfel)
        throw Error(
            "{}: {} surfels with {} rays each are more links than can be numbered (2^32); "
            "lower 'rays_per_surfel', or place_surfels's 'points_per_voxel'",
            kName, count, params_.raysPerSurfel);
    links.surfelCount = uint32_t(count);
    ensureSize(links.links, context.device, "surfel links", count * params_.raysPerSurfel * sizeof(uint32_t));
    if (keepsHits_)
        ensureSize(keptHits_, context.device, "hits of links",
                   (count + kHitBlock - 1) / kHitBlock * kHitBlock * params_.raysPerSurfel * sizeof(uint32_t));

    sort_.run(context.stream, surfels, context[voxels_].voxelCount, context[byVoxel_]);
    packSurfels(context);
    const bool isUpdate = !hasChanged || canUpdate(context);
    if (isUpdate && hasChanged)
        boxes_ = changedBoxes(context.stream, *context.frame.changedRegions, context[voxels_].grid.voxelSize);
    meanDistances_.begin(context.device, surfels, context[byVoxel_]);
    context.stream.fill(unlinkedHits_, 0);
    if (!context[surfels_].hasOccludedSurfels) context.stream.fill(occluded_, 0);
    const uint64_t rays = isUpdate && waiting_ ? linkWaiting(context, hasChanged) : linkAll(context, isUpdate);
    meanDistances_.pack(context, context[byVoxel_], context[voxels_].voxelCount);
    if (context[neighbors_].isRead && hasChanged) findNeighbors(context, isUpdate);
    boxes_ = {};
    const uint32_t unlinkedHits = context.stream.readAs<uint32_t>(unlinkedHits_, 1)[0];
    const double linkCount = double(context[byVoxel_].sortedCount) * params_.raysPerSurfel;
    context.report("links", linkCount);
    context.report("hits without surfel, % of rays", rays > 0 ? 100.0 * unlinkedHits / double(rays) : 0);
    if (keepsHits_)
        context.report("rays traced, % of all", 100.0 * double(rays) / (double(count) * params_.raysPerSurfel));
    if (waiting_)
        context.report("links that wait, % of all",
                       100.0 * double(waiting_->waiting()) / (double(count) * params_.raysPerSurfel));
}

uint64_t LinkSurfels::linkAll(PassContext& context, bool isUpdate) {
    const uint32_t perBatch = kBatchRays / params_.raysPerSurfel;
    uint64_t rays = 0;
    for (const Surfels::Chunk& chunk : context[surfels_].chunks) {
        for (uint32_t first = 0; first < chunk.count; first += perBatch) {
            const Batch batch{chunk, first, std::min(perBatch, chunk.count - first)};
            rays += link(context, batch, isUpdate);
            if (isUpdate) continue;
            meanDistances_.measure(context, context[byVoxel_], hits_, keptHits_, context[voxels_].grid.voxelSize,
                                   batch.firstIndex(), batch.count);
        }
        context.stream.finish();
    }
    if (waiting_) waiting_->clear(context, uint32_t(context[surfels_].count));
    return rays;
}

uint64_t LinkSurfels::linkWaiting(PassContext& context, bool hasChanged) {
    const Surfels& surfels = context[surfels_];
    if (hasChanged)
        for (const Surfels::Chunk& chunk : surfels.chunks) findChanged(context, {chunk, 0, chunk.count});
    waiting_->count(context);
    const glm::uvec2 pixels = context.frame.pixels();
    const double budget = double(params_.updateBudget) * pixels.x * pixels.y;
    auto left = uint64_t(std::floor(budget / (surfels.hasOccludedSurfels ? 2 : 1)));
    uint64_t traced = 0;
    while (const uint32_t rays = waiting_->select(context, std::min<uint64_t>(left, kBatchRays))) {
        context.stream.fill(listedCount_, 0);
        for (const Surfels::Chunk& chunk : surfels.chunks)
            waiting_->list(context, chunk, randomSeed(context.frame),
                           {{"rays", rays_}, {"listedRays", listedRays_}, {"listedCount", listedCount_}});
        context.tracer.closestHit(context.stream, rays_, hits_, rays);
        if (surfels.hasOccludedSurfels) traceOcclusion(context, rays);
        linkHits(context, 0, rays, true);
        left -= rays;
        traced += rays;
    }
    return traced;
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

uint32_t LinkSurfels::generateRays(PassContext& context, const Batch& batch) const {
    const uint32_t rays = batch.count * params_.raysPerSurfel;
    context.dispatch(generateRays_, rays,
                     {{"surfels", batch.chunk.surfels},
                      {"rays", rays_},
                      {"firstSurfel", batch.first},
                      {"rayCount", rays},
                      {"raysPerSurfel", params_.raysPerSurfel},
                      {"seed", randomSeed(context.frame)}});
    return rays;
}

uint32_t LinkSurfels::listChangedRays(PassContext& context, const Batch& batch) {
    context.stream.fill(listedCount_, 0);
    findChanged(context, batch);
    return context.stream.readAs<uint32_t>(listedCount_, 1)[0];
}

void LinkSurfels::findChanged(PassContext& context, const Batch& batch) {
    const SurfelLinks& links = context[links_];
    std::vector<Binding> waiting;
    if (waiting_) waiting = {waiting_->bits(), {"wordsPerSurfel", waiting_->wordsPerSurfel()}};
    const uint32_t groups = (batch.count + kSurfelGroup - 1) / kSurfelGroup;
    context.dispatch(listChangedLinks_, groups * kSurfelGroup,
                     {{"boxes", boxes_},
                      {"surfels", batch.chunk.surfels},
                      {"LinksRef", links.links.ref()},
                      {"LinkHitsRef", keptHits_.ref()},
                      {"InverseSumsRef", meanDistances_.sums().ref()},
                      ifUsed({"rays", rays_}),
                      ifUsed({"listedRays", listedRays_}),
                      ifUsed({"listedCount", listedCount_}),
                      {"firstInChunk", batch.first},
                      {"firstSurfel", batch.firstIndex()},
                      {"batchSurfels", batch.count},
                      {"raysPerSurfel", params_.raysPerSurfel},
                      {"surfelCount", links.surfelCount},
                      {"seed", randomSeed(context.frame)},
                      {"reach", kHitReach * context[voxels_].grid.voxelSize},
                      {"voxelSize", context[voxels_].grid.voxelSize},
                      waiting});
}

void LinkSurfels::traceOcclusion(PassContext& context, uint32_t rays) {
    context.dispatch(generateOcclusionRays_, rays,
                     {context.scene,
                      {"rays", rays_},
                      {"hits", hits_},
                      {"occlusionRays", occlusionRays_},
                      {"rayCount", rays},
                      {"voxelSize", context[voxels_].grid.voxelSize}});
    context.tracer.occluded(context.stream, occlusionRays_, occluded_, rays);
}

uint32_t LinkSurfels::link(PassContext& context, const Batch& batch, bool isUpdate) {
    const uint32_t rays = isUpdate ? listChangedRays(context, batch) : generateRays(context, batch);
    if (rays == 0) return 0;
    context.tracer.closestHit(context.stream, rays_, hits_, rays);
    if (context[surfels_].hasOccludedSurfels) traceOcclusion(context, rays);
    linkHits(context, batch.firstIndex(), rays, isUpdate);
    return rays;
}

void LinkSurfels::linkHits(PassContext& context, uint32_t firstSurfel, uint32_t rays, bool isUpdate) {
    const SurfelLinks& links = context[links_];
    const SurfelsByVoxel& byVoxel = context[byVoxel_];
    context.stream.fill(farCount_, 0);
    for (const Kernel* kernel : {&linkHits_, &linkFarHits_})
        context.dispatch(*kernel, rays,
                         {context.scene,
                          context[voxels_],
                          {"rays", rays_},
                          {"hits", hits_},
                          {"occluded", occluded_},
                          {"SortedRef", byVoxel.sorted.ref()},
                          {"surfelRanges", byVoxel.ranges},
                          {"LinksRef", links.links.ref()},
                          {"farRays", farRays_},
                          {"farCount", farCount_},
                          ifUsed({"unlinkedHits", unlinkedHits_}),
                          {"firstSurfel", firstSurfel},
                          {"rayCount", rays},
                          {"raysPerSurfel", params_.raysPerSurfel},
                          {"surfelCount", links.surfelCount},
                          ifUsed({"LinkHitsRef", keptHits_.ref()}),
                          ifUsed({"InverseSumsRef", meanDistances_.sums().ref()}),
                          ifUsed({"listedRays", listedRays_}),
                          ifUsed({"isListed", isUpdate})});
}

void LinkSurfels::findNeighbors(PassContext& context, bool isUpdate) {
    const SurfaceVoxels& voxels = context[voxels_];
    SurfelNeighbors& neighbors = context[neighbors_];
    if (isUpdate)
        neighborSearch_.update(context.stream, voxels, context[surfels_], context[byVoxel_], boxes_,
                               kHitReach * voxels.grid.voxelSize, neighbors);
    else
        neighborSearch_.run(context.stream, voxels, context[surfels_], context[byVoxel_], neighbors);
    context.report("radius of neighbors, voxels", neighbors.radius);
}

VOXRAY_REGISTER_PASS(LinkSurfels);

}  // namespace voxray
