#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/clusters/cluster_visibility.h"
#include "passes/clusters/cluster_visibility/patch_surfel.h"
#include "passes/clusters/cluster_visibility/ray_update_cache.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/bit_words.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/compute/uint_bytes.h"
#include "passes/common/voxel_march/voxel_march.h"
#include "passes/surfels/surfel_points.h"
#include "trace/ray.h"

namespace voxray {
namespace {

constexpr uint32_t kChunkRays = 1u << 20;  // Rays of a chunk (a range of patches), which take at most 32 MiB.
/// A hit belongs to the surface group of the first nearby surfel that sees the hit point; up to 4 are tried.
constexpr uint32_t kMaxCandidates = 4;
constexpr uint32_t kMaxGroups = (1u << 28) - 1;  // Limit of packed_hit.glsl.

/// The surfel now tested, its group, and the groups of earlier ones that did not see the hit point. As in
/// find_hit_groups.comp.
struct Candidate {
    uint32_t surfel;
    uint32_t group;
    uint32_t rejectedGroups[kMaxCandidates];
};

/// Mean numbers for estimates of memory. Measured: with 'near_distance: 0', which leaves only clusters in lists, a list
/// grows with the square root of the number of rays, since many rays hit the same cluster (docs/papers/cosin2022.md).
constexpr double kPatchesPerVoxel = 6, kEntriesPerSqrtRays = 4;

}  // namespace

/// What rays are traced through. Triangles: those of the scene. Voxels: every voxel on the way. Bresenham: the voxels
/// of a Bresenham line, as in the paper.
enum class RayTraversal { Triangles, Voxels, Bresenham };
template <>
struct EnumNames<RayTraversal> {
    static constexpr std::array names{std::pair{RayTraversal::Triangles, "exact"},
                                      std::pair{RayTraversal::Voxels, "voxels"},
                                      std::pair{RayTraversal::Bresenham, "bresenham"}};
};

/// The axis of the cosine distribution of rays: the surfel's normal or the axis of the patch's face.
enum class HemisphereAxis { Surface, Face };
template <>
struct EnumNames<HemisphereAxis> {
    static constexpr std::array names{std::pair{HemisphereAxis::Surface, "surface"},
                                      std::pair{HemisphereAxis::Face, "face"}};
};

/// Builds the visibility list of each patch from cosine-distributed rays, once for a scene. Light is gathered
/// along these lists whenever it changes. Where surfaces move, only rays that the change may affect are
/// traced again. Source: Cosin and Patow 2022, section 4.3.
class FindClusterVisibility final : public Pass {
 public:
    static constexpr const char* kName = "cluster_visibility";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Measures form factors from each patch to voxel clusters. "
        "Traces cosine-distributed rays from the surfels of each patch (find_patches: "
        "a surface group as seen from one of its voxel's six faces). "
        "Lists the cluster components that they hit, with the number of rays for each; "
        "divided by 'rays' it is a form factor. "
        "Surfaces within near_distance are listed as patches instead of clusters. "
        "Biased by: cluster size; with 'visibility: voxels' or 'bresenham' also by voxel size "
        "(surfaces are as thick as their voxels). "
        "Noisy by: rays. Source: Cosin and Patow 2022, section 4.3.";
    struct Params {
        uint32_t rays = 128;
        float nearDistance = 4;
        RayTraversal visibility = RayTraversal::Triangles;
        HemisphereAxis hemisphere = HemisphereAxis::Surface;
        static constexpr auto schema() {
            return std::tuple{
                field("rays", &Params::rays, "Rays from each patch.", 1u, MAX_RAYS_PER_PATCH).lessNoise(),
                field("near_distance", &Params::nearDistance,
                      "Distance in voxels below which lists have patches, and beyond which they have clusters. "
                      "0: clusters only. 10000: patches only, for comparison.",
                      0.0f, 10000.0f),
                field("visibility", &Params::visibility,
                      "exact: rays are traced through the scene. voxels: through every voxel on their way. "
                      "bresenham: through the voxels of a Bresenham line, which misses some (the paper's)."),
                field("hemisphere", &Params::hemisphere,
                      "Axis of the rays' cosine distribution. surface: the surfel's normal. "
                      "face: the axis of the patch's face (the paper's).")};
        }
    };

    explicit FindClusterVisibility(const Params& params) : params_(params) {
        if (!tracesTriangles()) march_.emplace(*this, VoxelTraversal::Bricks);
    }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool listsPatches() const { return params_.nearDistance > 0; }
    bool tracesTriangles() const { return params_.visibility == RayTraversal::Triangles; }
    /// Fills surfels_. If rays are traced through triangles, also measures the clearance of occluded surfels, their
    /// distance to the surface in front: occlusion rays from hits end at half of it.
    void evaluateSurfels(PassContext& context);
    /// Builds the lists of `count` patches from `first` on.
    void buildChunk(PassContext& context, uint32_t first, uint32_t count);
    /// The bindings of patch_samples.glsl except `rayCount` and `round`.
    std::vector<Binding> rayBindings(PassContext& context, uint32_t firstPatch) const;
    /// Finds the hits of `count` rays through the scene; hits of the previous build that are still valid are
    /// reused. @return the number of rays traced.
    uint32_t traceRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count,
                       const Buffer& packedHits);
    /// The same through voxels.
    void marchRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count, const Buffer& packedHits);
    /// Lists the rays that have to be traced. @return their number.
    uint32_t listRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count, const Buffer& packedHits);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelClusters> clusters_{*this, "clusters", "clusters; only their voxel coordinates are read"};
    In<SurfelPoints> points_{*this, "surfel_points", "points of their surfaces"};
    In<VoxelPatches> patches_{*this, "patches", "surface groups and patches of voxels"};
    Out<ClusterVisibility> visibility_{*this, "cluster_visibility", "visibility lists of patches"};
    std::optional<VoxelMarch> march_;  ///< For rays through voxels.
    PrefixSum prefixSum_{*this, PrefixSum::Input::Uints};
    std::optional<Compaction> compaction_;       ///< For scenes with moving surfaces.
    std::optional<RayUpdateCache> updateCache_;  ///< Likewise.
    uint64_t tracedRays_ = 0;                    ///< In the current call of record().
    Kernel evaluateSurfels_{*this, "evaluate_surfels.comp"};
    Kernel measureClearance_{*this, "measure_clearance.comp"};
    bool measuresClearance_ = false;
    Kernel listPatchFaces_{*this, "list_patch_faces.comp"};
    Kernel marchRays_{*this, "march_voxels.comp"};
    Kernel listAllRays_{*this, "passes/clusters/iota.comp"};
    Kernel generateRays_{*this, "generate_patch_rays.comp"};
    Kernel findHitGroups_{*this, "find_hit_groups.comp"};
    // A list target is a patch, or a face of a cluster component
    Kernel hitsToTargets_{*this, "hits_to_targets.comp"};
    Kernel mergeTargets_{*this, "merge_targets.comp"};
    Kernel packLists_{*this, "pack_lists.comp"};
    LargeBuffer surfels_;  ///< gpu::PatchSurfel each, while the pass records.
    Buffer patchFaces_, packedHits_, targets_, listHeaders_, listBits_, entryCount_, lostRays_;  ///< Scratch.
    Buffer flags_, listedRays_, rays_, hits_, candidates_, occlusionRays_, occluded_;
};

void FindClusterVisibility::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan[voxels_];
    ClusterVisibility& visibility = plan[visibility_];
    const uint32_t chunk = kChunkRays / params_.rays;
    visibility.listsPatches = listsPatches();
    visibility.layout = {params_.rays, chunk, 0, uint32_t(std::bit_width(params_.rays - 1))};
    const uint64_t rays = uint64_t(chunk) * params_.rays;
    plan.scratchBuffer(targets_, "targets of rays", rays * sizeof(uint32_t));
    plan.scratchBuffer(listHeaders_, "headers of visibility lists", chunk * sizeof(uint32_t));
    plan.scratchBuffer(listBits_, "lengths of visibility lists", (chunk + 1) * sizeof(uint32_t));
    plan.scratchBuffer(entryCount_, "number of visibility list entries", sizeof(uint32_t));
    plan.scratchBuffer(lostRays_, "rays without a target", 2 * sizeof(uint32_t));
    const bool reusesHits = tracesTriangles() && !movingInstanceRanges(plan.frame.scene->geometry).empty();
    if (reusesHits) {
        compaction_.emplace(*this);
        updateCache_.emplace(*this);
    } else {
        plan.scratchBuffer(packedHits_, "packed hits", rays * sizeof(uint32_t));
    }
    const double raysPerPatch = params_.rays, cachedHits = reusesHits ? raysPerPatch : 0;
    const double entries =
        listsPatches() ? raysPerPatch : std::min(raysPerPatch, kEntriesPerSqrtRays * std::sqrt(raysPerPatch));
    plan.estimate(voxels.estimatedCount * kPatchesPerVoxel * (entries + cachedHits) * sizeof(uint32_t));
    measuresClearance_ = tracesTriangles() && plan[points_].hasOccludedSurfels;
    if (measuresClearance_) evaluateSurfels_.define({{"CLEARANCE", "1"}});
    measureClearance_.compileIf(measuresClearance_);
    marchRays_.compileIf(!tracesTriangles());
    for (Kernel* kernel : {&listAllRays_, &generateRays_, &findHitGroups_}) kernel->compileIf(tracesTriangles());
    if (!tracesTriangles()) {
        Defines defines = march_->defines();
        if (params_.visibility == RayTraversal::Bresenham) defines.emplace("BRESENHAM", "1");
        marchRays_.define(defines);
        march_->plan(plan, voxels);
        return;
    }
    const uint64_t words = bitWords(rays);
    if (reusesHits) plan.scratchBuffer(flags_, "rays to trace", words * sizeof(uint32_t));
    plan.scratchBuffer(listedRays_, "listed rays", rays * sizeof(uint32_t));
    plan.scratchBuffer(rays_, "rays of patches", rays * sizeof(Ray));
    plan.scratchBuffer(hits_, "hits of patches' rays", rays * sizeof(Hit));
    plan.scratchBuffer(candidates_, "candidate surfels of hits", rays * sizeof(Candidate));
    plan.scratchBuffer(occlusionRays_, "visibility rays from hits", rays * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility of hits", rays * sizeof(uint32_t));
}

void FindClusterVisibility::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& voxels = context[voxels_];
    const VoxelPatches& patches = context[patches_];
    ClusterVisibility& visibility = context[visibility_];
    const std::optional<std::vector<Box>>& changed = context.frame.changedRegions;
    visibility.chunks.clear();
    visibility.chunkAddresses = {};
    visibility.patchCount = patches.patchCount;
    visibility.layout.firstPatchTarget = patches.componentFaceCount;
    const uint64_t targets = uint64_t(patches.componentFaceCount) + (listsPatches() ? uint64_t(patches.patchCount) : 0);
    if (visibility.layout.rayBits + std::bit_width(targets) > 32)
        throw Error(
            "{}: a list entry needs over 32 bits for {} targets and {} rays; set 'near_distance: 0', or lower 'rays', "
            "cluster_voxels's 'target' or voxelize's 'resolution'",
            kName, targets, params_.rays);
    if (patches.groupCount > kMaxGroups)
        throw Error("{}: {} surface groups exceed the limit of {}; lower voxelize's 'resolution'", kName,
                    patches.groupCount, kMaxGroups);

    CommandStream& stream = context.stream;
    if (march_) march_->begin(stream, voxels);
    if (updateCache_ && changed && !context.isFirstRun() && patches.previousGroupIndex)
        updateCache_->startUpdate(stream, voxels, context[clusters_], patches, *changed);
    else if (updateCache_)
        updateCache_->clear();
    evaluateSurfels(context);
    const uint32_t count = patches.patchCount, perChunk = visibility.layout.patchesPerChunk;
    patchFaces_ = Buffer(context.device, "faces of patches", uintBytes(count));
    context.dispatch(listPatchFaces_, patches.groupCount,
                     {{"groups", patches.groups}, {"patchFaces", patchFaces_}, {"groupCount", patches.groupCount}});
    stream.fill(lostRays_, 0);
    stream.fill(entryCount_, 0);
    tracedRays_ = 0;
    for (uint32_t first = 0; first < count; first += perChunk)
        buildChunk(context, first, std::min(perChunk, count - first));
    stream.finish();
    patchFaces_ = {}, surfels_ = {};
    if (updateCache_) updateCache_->store(stream, patches);
    if (march_) context.marchCounters.push_back(&march_->counts());

    std::vector<uint64_t> addresses;
    for (const ClusterVisibility::Chunk& chunk : visibility.chunks)
        addresses.insert(addresses.end(), {chunk.offsets.address(), chunk.entries.address()});
    if (addresses.empty()) addresses.resize(2);
    visibility.chunkAddresses =
        Buffer(context.device, "addresses of visibility lists", addresses.size() * sizeof(uint64_t));
    stream.upload(visibility.chunkAddresses, addresses);
    const double rays = double(count) * params_.rays;
    visibility.entryCount = stream.readAs<uint32_t>(entryCount_, 1).front();
    const std::vector<uint32_t> lostRays = stream.readAs<uint32_t>(lostRays_, 2);
    const auto percent = [&](uint32_t lost) { return count > 0 ? 100 * lost / rays : 0; };
    // "Hits without surfel": no candidate surfel saw the hit (HIT_NO_GROUP, packed_hit.glsl)
    context.report("patches", count);
    context.report("visibility list entries of a patch", count > 0 ? double(visibility.entryCount) / count : 0);
    context.report("rays without a hit, %", percent(lostRays[0]));
    context.report("hits without surfel, % of rays", percent(lostRays[1]));
    context.report("bytes of the lists", double(visibility.bytes()));
    if (updateCache_) context.report("rays traced, % of all", count > 0 ? 100 * double(tracedRays_) / rays : 0);
}

void FindClusterVisibility::evaluateSurfels(PassContext& context) {
    const VoxelPatches& patches = context[patches_];
    surfels_ = LargeBuffer(context.device, "surfels of patches",
                           std::max<uint64_t>(patches.surfelCount, 1) * sizeof(gpu::PatchSurfel));
    const SurfelPoints& points = context[points_];
    const uint32_t batch = context[visibility_].layout.patchesPerChunk * params_.rays;
    for (uint32_t first = 0; first < patches.surfelCount; first += batch) {
        const uint32_t count = std::min(batch, patches.surfelCount - first);
        const Bindings range{{"PatchSurfelsRef", surfels_.ref()}, {"first", first}, {"count", count}};
        context.dispatch(evaluateSurfels_, count,
                         {context.scene,
                          points,
                          range.all(),
                          {"SurfelIdsRef", patches.surfelIds.ref()},
                          ifUsed({"SidesRef", points.sides.ref()}),
                          ifUsed({"rays", rays_}),
                          {"voxelSize", context[voxels_].grid.voxelSize}});
        if (!measuresClearance_) continue;
        context.tracer.closestHit(context.stream, rays_, hits_, count);
        context.dispatch(measureClearance_, count, {range.all(), {"hits", hits_}});
    }
}

std::vector<Binding> FindClusterVisibility::rayBindings(PassContext& context, uint32_t firstPatch) const {
    const VoxelPatches& patches = context[patches_];
    return {{"patchFaces", patchFaces_},
            {"groups", patches.groups},
            {"PatchSurfelsRef", surfels_.ref()},
            {"grid", context[voxels_].grid},
            {"listLayout", context[visibility_].layout},
            {"firstPatch", firstPatch},
            {"seed", randomSeed(context.frame)},
            {"nearDistance", params_.nearDistance},
            {"aboutFaceAxis", params_.hemisphere == HemisphereAxis::Face}};
}

uint32_t FindClusterVisibility::listRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count,
                                         const Buffer& packedHits) {
    CommandStream& stream = context.stream;
    if (!updateCache_ || !updateCache_->isActive()) {
        stream.dispatch(listAllRays_, count, {{"values", listedRays_}, {"count", count}});
        return count;
    }
    stream.fill(flags_, 0);
    updateCache_->reuse(
        stream,
        {context.scene, rays, {"packedHits", packedHits}, {"flags", flags_}, {"rayCount", count}, {"round", 0u}},
        count);
    return compaction_->run(stream, flags_, listedRays_, uint32_t(bitWords(count)));
}

uint32_t FindClusterVisibility::traceRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count,
                                          const Buffer& packedHits) {
    const VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t listed = listRays(context, rays, count, packedHits);
    if (listed == 0) return 0;
    const Bindings listedRays{context.scene, rays, {"listedRays", listedRays_}, {"rays", rays_}, {"rayCount", listed}};
    context.dispatch(generateRays_, listed, {listedRays.all(), {"round", 0u}});
    context.tracer.closestHit(stream, rays_, hits_, listed);
    // Each round first reads the occlusion traced in the previous one; the last does only that
    for (uint32_t round = 0; round <= kMaxCandidates; ++round) {
        context.dispatch(findHitGroups_, listed,
                         {listedRays.all(),
                          context[voxels_],
                          {"firstGroup", patches.firstGroup},
                          {"GroupMaterialsRef", patches.materials.ref()},
                          {"hits", hits_},
                          {"candidates", candidates_},
                          {"occlusionRays", occlusionRays_},
                          {"occluded", occluded_},
                          {"packedHits", packedHits},
                          {"round", round}});
        if (round < kMaxCandidates) context.tracer.occluded(stream, occlusionRays_, occluded_, listed);
    }
    return listed;
}

void FindClusterVisibility::marchRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count,
                                      const Buffer& packedHits) {
    const VoxelPatches& patches = context[patches_];
    std::vector<Binding> march = march_->bindings();
    for (Binding& binding : march) binding.optional = true;  // BRESENHAM does not use all of them.
    context.dispatch(marchRays_, count,
                     {march,
                      rays,
                      {"firstGroup", patches.firstGroup},
                      {"GroupMaterialsRef", patches.materials.ref()},
                      {"packedHits", packedHits},
                      {"rayCount", count},
                      {"round", 0u}});
}

void FindClusterVisibility::buildChunk(PassContext& context, uint32_t first, uint32_t count) {
    const VoxelPatches& patches = context[patches_];
    ClusterVisibility& visibility = context[visibility_];
    CommandStream& stream = context.stream;
    const std::vector<Binding> rays = rayBindings(context, first);
    const uint32_t rayCount = count * params_.rays;
    const Buffer& packedHits = updateCache_ ? updateCache_->addChunk(context.device, rayCount) : packedHits_;
    if (tracesTriangles())
        tracedRays_ += traceRays(context, rays, rayCount, packedHits);
    else
        marchRays(context, rays, rayCount, packedHits);
    context.dispatch(hitsToTargets_, rayCount,
                     {{"packedHits", packedHits},
                      {"groups", patches.groups},
                      {"components", patches.components},
                      {"componentOfGroup", patches.componentOfGroup},
                      {"targets", targets_},
                      {"lostRays", lostRays_},
                      {"listLayout", visibility.layout},
                      {"rays", rayCount}});

    const Bindings lists{
        {"targets", targets_}, {"listHeaders", listHeaders_}, {"listLayout", visibility.layout}, {"patchCount", count}};
    context.dispatch(mergeTargets_, uint64_t(count) + 1,
                     {lists.all(), {"listBits", listBits_}, {"EntryCount", entryCount_}});
    ClusterVisibility::Chunk chunk;
    chunk.offsets = Buffer(context.device, "offsets of visibility lists", (count + 1) * sizeof(uint32_t));
    const uint64_t words = bitWords(prefixSum_.run(stream, listBits_, chunk.offsets, count + 1));
    chunk.entries = Buffer(context.device, "visibility lists", std::max<uint64_t>(words, 1) * sizeof(uint32_t));
    stream.fill(chunk.entries, 0);
    context.dispatch(packLists_, count, {lists.all(), {"offsets", chunk.offsets}, {"entries", chunk.entries}});
    stream.finish();
    visibility.chunks.push_back(std::move(chunk));
}

VOXRAY_REGISTER_PASS(FindClusterVisibility);

}  // namespace voxray
