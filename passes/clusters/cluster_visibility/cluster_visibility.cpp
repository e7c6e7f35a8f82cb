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
#include "passes/clusters/cluster_visibility/kept_rays.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/compaction.h"
#include "passes/common/compute/prefix_sum.h"
#include "passes/common/compute/random_seed.h"
#include "passes/common/voxel_march/voxel_march.h"
#include "trace/ray.h"

namespace voxray {
namespace {

constexpr uint32_t kChunkRays = 1u << 20;       // Bounds the rays in hand to 32 MiB.
constexpr uint32_t kRounds = 4;                 // As in choose.comp.
constexpr uint32_t kMaxSides = (1u << 28) - 1;  // As met.glsl numbers them.

/// As in choose.comp.
struct Proposal {
    uint32_t surfel;
    uint32_t hidden[kRounds];
};

/// For the estimate, in the mean. Several rays of a patch meet the same cluster, so that lists of clusters
/// alone grow with the root of rays (docs/papers/cosin2022.md).
constexpr double kPatchesPerVoxel = 6, kSeenByRootOfRays = 4;

}  // namespace

/// What rays of faces meet.
enum class FaceRays { Exact, Voxels, Bresenham };
template <>
struct EnumNames<FaceRays> {
    static constexpr std::array names{std::pair{FaceRays::Exact, "exact"},
                                      std::pair{FaceRays::Voxels, "voxels"},
                                      std::pair{FaceRays::Bresenham, "bresenham"}};
};

/// What the rays of a face are distributed about.
enum class FaceHemisphere { Surface, Face };
template <>
struct EnumNames<FaceHemisphere> {
    static constexpr std::array names{std::pair{FaceHemisphere::Surface, "surface"},
                                      std::pair{FaceHemisphere::Face, "face"}};
};

/// Finds which clusters each patch of each voxel sees, once for a scene: light is gathered from these lists.
/// Where surfaces move, rays through the scene are traced again where these have changed.
/// Source: Cosin and Patow 2022, section 4.3.
class FindClusterVisibility final : public Pass {
 public:
    static constexpr const char* kName = "cluster_visibility";
    static constexpr const char* kHelp =
        "Measures form factors from each patch of surfels to voxel clusters. Sends rays from the surfels of "
        "each patch (a face of one of the sides in a voxel, find_patches), by the cosine about their normal. "
        "Lists the clusters' parts that they meet, with the number of rays for each: a form factor. What is "
        "near is listed by its voxels. Biased by: cluster size; through voxels also by voxel size (surfaces "
        "are as thick as their voxels). Noisy by: rays. Source: Cosin and Patow 2022, section 4.3.";
    struct Params {
        uint32_t rays = 128;
        float nearDistance = 4;
        FaceRays visibility = FaceRays::Exact;
        FaceHemisphere hemisphere = FaceHemisphere::Surface;
        static constexpr auto schema() {
            return std::tuple{
                field("rays", &Params::rays, "From each patch.", 1u, SEEN_MAX_RAYS).lessNoise(),
                field(
                    "near_distance", &Params::nearDistance,
                    "What is nearer than this many voxels is seen by its voxels, and what is farther by its "
                    "clusters. 0: all by clusters. 10000: all by voxels, for comparison.",
                    0.0f, 10000.0f),
                field("visibility", &Params::visibility,
                      "exact: rays go through the scene. voxels: through voxels, all that they meet. "
                      "bresenham: the paper's walk through voxels, which passes some by."),
                field(
                    "hemisphere", &Params::hemisphere,
                    "surface: rays leave by the cosine about the surfels' normal. face: about the face's own "
                    "axis (the paper's).")};
        }
    };

    explicit FindClusterVisibility(const Params& params) : params_(params) {
        if (!isExact()) march_.emplace(*this, VoxelWalk::Bricks);
    }
    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    bool seesPatches() const { return params_.nearDistance > 0; }
    bool isExact() const { return params_.visibility == FaceRays::Exact; }
    /// Lists what `count` patches from `first` on see.
    void look(PassContext& context, uint32_t first, uint32_t count);
    /// Of face_ray.glsl, but for `rayCount` and `round`.
    std::vector<Binding> rayBindings(PassContext& context, uint32_t firstPatch) const;
    /// Writes what `count` rays met, those that are to be traced and those that are kept. @return rays
    /// traced.
    uint32_t traceRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count,
                       const Buffer& met);
    void marchRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count, const Buffer& met);
    /// Lists the rays that are to be traced. @return how many.
    uint32_t listRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count,
                      const Buffer& met);

    const Params params_;
    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<VoxelClusters> clusters_{*this, "clusters", "where voxels are"};
    In<VoxelPatches> patches_{*this, "patches", "surfaces by the open space that they look into"};
    Out<ClusterVisibility> visibility_{*this, "cluster_visibility", "which clusters each patch sees"};
    std::optional<VoxelMarch> march_;  ///< For rays through voxels.
    PrefixSum prefixSum_{*this, PrefixSum::Of::Values};
    std::optional<Compaction> compaction_;  ///< Where surfaces move.
    std::optional<KeptRays> kept_;          ///< Likewise.
    uint64_t traced_ = 0;                   ///< Rays, in this build.
    Kernel listFaces_{*this, "faces.comp"};
    Kernel marchRays_{*this, "march.comp"};
    Kernel all_{*this, "all.comp"};
    Kernel emit_{*this, "emit.comp"};
    Kernel choose_{*this, "choose.comp"};
    Kernel targetsOf_{*this, "targets.comp"};
    Kernel merge_{*this, "merge.comp"};
    Kernel compact_{*this, "compact.comp"};
    Buffer faces_, met_, targets_, counts_, missed_;  ///< Scratch.
    Buffer flags_, list_, rays_, hits_, proposals_, between_, occluded_;
};

void FindClusterVisibility::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan[voxels_];
    ClusterVisibility& visibility = plan[visibility_];
    const uint32_t chunk = kChunkRays / params_.rays;
    visibility.listsPatches = seesPatches();
    visibility.layout = {params_.rays, chunk, 0, uint32_t(std::bit_width(params_.rays - 1)), 32};
    const uint64_t rays = uint64_t(chunk) * params_.rays;
    plan.scratchBuffer(targets_, "targets of rays", rays * sizeof(uint32_t));
    plan.scratchBuffer(counts_, "targets of patches", (chunk + 1) * sizeof(uint32_t));
    plan.scratchBuffer(missed_, "rays that met nothing", 2 * sizeof(uint32_t));
    const bool keeps = isExact() && !movingRuns(plan.frame.scene->geometry).empty();
    if (keeps) {
        compaction_.emplace(*this);
        kept_.emplace(*this);
    } else {
        plan.scratchBuffer(met_, "what rays met", rays * sizeof(uint32_t));
    }
    const double all = params_.rays, kept = keeps ? all : 0;
    const double seen = seesPatches() ? all : std::min(all, kSeenByRootOfRays * std::sqrt(all));
    plan.estimate(voxels.estimatedCount * kPatchesPerVoxel * (seen + kept) * sizeof(uint32_t));
    marchRays_.compileIf(!isExact());
    for (Kernel* kernel : {&all_, &emit_, &choose_}) kernel->compileIf(isExact());
    if (!isExact()) {
        Defines defines = march_->defines();
        if (params_.visibility == FaceRays::Bresenham) defines.emplace("BRESENHAM", "1");
        marchRays_.define(defines);
        march_->plan(plan, voxels);
        return;
    }
    const uint64_t words = (rays + 31) / 32;
    if (keeps) plan.scratchBuffer(flags_, "rays to trace", words * sizeof(uint32_t));
    plan.scratchBuffer(list_, "rays by number", rays * sizeof(uint32_t));
    plan.scratchBuffer(rays_, "rays of patches", rays * sizeof(Ray));
    plan.scratchBuffer(hits_, "hits of patches' rays", rays * sizeof(Hit));
    plan.scratchBuffer(proposals_, "what rays may have hit", rays * sizeof(Proposal));
    plan.scratchBuffer(between_, "rays from hits", rays * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility of hits", rays * sizeof(uint32_t));
}

void FindClusterVisibility::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& voxels = context[voxels_];
    const VoxelPatches& patches = context[patches_];
    ClusterVisibility& visibility = context[visibility_];
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    visibility.chunks.clear();
    visibility.entries = 0;
    visibility.addresses = {};
    visibility.patchCount = patches.patchCount;
    visibility.layout.sideTargets = kFaces * patches.partCount;
    const uint64_t targets =
        uint64_t(kFaces) * patches.partCount + (seesPatches() ? uint64_t(patches.patchCount) : 0);
    gpu::SeenLayout& layout = visibility.layout;
    layout.entryBits = std::max(layout.rayBits + uint32_t(std::bit_width(targets)), 1u);
    if (layout.entryBits > 32 || patches.sideCount > kMaxSides)
        throw Error(
            "{}: {} faces of clusters and patches and {} rays don't fit into 32 bits; set "
            "'near_distance: 0', or lower 'rays', cluster_voxels's 'target' or voxelize's 'resolution'",
            kName, targets, params_.rays);

    CommandStream& stream = context.stream;
    if (march_) march_->begin(stream, voxels);
    if (kept_ && changed && !context.isFirstRun() && patches.previousSides)
        kept_->begin(stream, voxels, context[clusters_], patches, *changed);
    else if (kept_)
        kept_->clear();
    const uint32_t count = patches.patchCount, perChunk = visibility.layout.patchesPerChunk;
    faces_ = Buffer(context.device, "faces of patches", std::max(count, 1u) * sizeof(uint32_t));
    context.dispatch(listFaces_, patches.sideCount,
                     {{"sides", patches.sides}, {"faces", faces_}, {"sideCount", patches.sideCount}});
    stream.fill(missed_, 0);
    traced_ = 0;
    for (uint32_t first = 0; first < count; first += perChunk)
        look(context, first, std::min(perChunk, count - first));
    faces_ = {};
    if (kept_) kept_->remember(stream, patches);
    if (march_) context.voxelCounts.push_back(&march_->counts());

    std::vector<uint64_t> addresses;
    for (const ClusterVisibility::Chunk& chunk : visibility.chunks)
        addresses.insert(addresses.end(), {chunk.first.address(), chunk.seen.address()});
    if (addresses.empty()) addresses.resize(2);
    visibility.addresses = Buffer(context.device, "addresses of lists", addresses.size() * sizeof(uint64_t));
    stream.upload(visibility.addresses, addresses);
    const double rays = double(count) * params_.rays;
    const std::vector<uint32_t> missed = stream.readAs<uint32_t>(missed_, 2);
    const auto percent = [&](uint32_t lost) { return count > 0 ? 100 * lost / rays : 0; };
    context.report("patches", count);
    context.report("clusters and voxels seen by a patch", count > 0 ? double(visibility.entries) / count : 0);
    context.report("rays that met nothing, %", percent(missed[0]));
    context.report("hits without surfel, % of rays", percent(missed[1]));
    context.report("bytes of the lists", double(visibility.bytes()));
    if (kept_) context.report("rays traced, % of all", count > 0 ? 100 * double(traced_) / rays : 0);
}

std::vector<Binding> FindClusterVisibility::rayBindings(PassContext& context, uint32_t firstPatch) const {
    const VoxelPatches& patches = context[patches_];
    return {{"faces", faces_},
            {"sides", patches.sides},
            {"PatchSurfelsAt", patches.surfels.at()},
            {"grid", context[voxels_].grid},
            {"lists", context[visibility_].layout},
            {"firstPatch", firstPatch},
            {"seed", randomSeed(context.frame)},
            {"nearDistance", params_.nearDistance},
            {"alongAxis", params_.hemisphere == FaceHemisphere::Face}};
}

uint32_t FindClusterVisibility::listRays(PassContext& context, const std::vector<Binding>& rays,
                                         uint32_t count, const Buffer& met) {
    CommandStream& stream = context.stream;
    if (!kept_ || !kept_->isActive()) {
        stream.dispatch(all_, count, {{"list", list_}, {"rays", count}});
        return count;
    }
    stream.fill(flags_, 0);
    kept_->keep(stream,
                {context.scene, rays, {"met", met}, {"flags", flags_}, {"rayCount", count}, {"round", 0u}},
                count);
    return compaction_->run(stream, flags_, list_, (count + 31) / 32);
}

uint32_t FindClusterVisibility::traceRays(PassContext& context, const std::vector<Binding>& rays,
                                          uint32_t count, const Buffer& met) {
    const VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t listed = listRays(context, rays, count, met);
    if (listed == 0) return 0;
    const Bindings listedRays{context.scene, rays, {"list", list_}, {"rays", rays_}, {"rayCount", listed}};
    context.dispatch(emit_, listed, {listedRays.all(), {"round", 0u}});
    context.tracer.closestHit(stream, rays_, hits_, listed);
    for (uint32_t round = 0; round <= kRounds; ++round) {
        context.dispatch(choose_, listed,
                         {listedRays.all(),
                          context[voxels_],
                          {"firstSide", patches.firstSide},
                          {"VoxelMaterialsAt", patches.materials.at()},
                          {"hits", hits_},
                          {"proposals", proposals_},
                          {"between", between_},
                          {"occluded", occluded_},
                          {"met", met},
                          {"round", round}});
        if (round < kRounds) context.tracer.occluded(stream, between_, occluded_, listed);
    }
    return listed;
}

void FindClusterVisibility::marchRays(PassContext& context, const std::vector<Binding>& rays, uint32_t count,
                                      const Buffer& met) {
    const VoxelPatches& patches = context[patches_];
    std::vector<Binding> march = march_->bindings();
    for (Binding& binding : march) binding.optional = true;  // BRESENHAM walks on its own.
    context.dispatch(marchRays_, count,
                     {march,
                      rays,
                      {"firstSide", patches.firstSide},
                      {"VoxelMaterialsAt", patches.materials.at()},
                      {"met", met},
                      {"rayCount", count},
                      {"round", 0u}});
}

void FindClusterVisibility::look(PassContext& context, uint32_t first, uint32_t count) {
    const VoxelPatches& patches = context[patches_];
    ClusterVisibility& visibility = context[visibility_];
    CommandStream& stream = context.stream;
    const std::vector<Binding> rays = rayBindings(context, first);
    const uint32_t rayCount = count * params_.rays;
    const Buffer& met = kept_ ? kept_->add(context.device, rayCount) : met_;
    if (isExact())
        traced_ += traceRays(context, rays, rayCount, met);
    else
        marchRays(context, rays, rayCount, met);
    context.dispatch(targetsOf_, rayCount,
                     {{"met", met},
                      {"sides", patches.sides},
                      {"ofSide", patches.ofSide},
                      {"targets", targets_},
                      {"missed", missed_},
                      {"lists", visibility.layout},
                      {"rays", rayCount}});

    // Merged by patch, and moved together
    const Bindings list{{"targets", targets_}, {"lists", visibility.layout}, {"patches", count}};
    context.dispatch(merge_, uint64_t(count) + 1, {list.all(), {"counts", counts_}});
    ClusterVisibility::Chunk chunk;
    chunk.first = Buffer(context.device, "where patches' lists begin", (count + 1) * sizeof(uint32_t));
    const uint32_t seen = prefixSum_.run(stream, counts_, chunk.first, count + 1);
    const uint64_t words = (uint64_t(seen) * visibility.layout.entryBits + 31) / 32;
    chunk.seen = Buffer(context.device, "what patches see", std::max<uint64_t>(words, 1) * sizeof(uint32_t));
    stream.fill(chunk.seen, 0);
    context.dispatch(compact_, count, {list.all(), {"first", chunk.first}, {"seen", chunk.seen}});
    stream.finish();
    visibility.chunks.push_back(std::move(chunk));
    visibility.entries += seen;
}

VOXRAY_REGISTER_PASS(FindClusterVisibility);

}  // namespace voxray
