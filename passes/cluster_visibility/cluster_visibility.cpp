#include "passes/cluster_visibility/cluster_visibility.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
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

/// Of what patches see, by clusters alone: several rays of a patch meet the same one, so that lists grow with
/// the root of rays (docs/papers/cosin2022.md). About this many times the root are expected, in the mean.
constexpr double kSeenByRootOfRays = 4;

struct ListPush {
    gpu::SeenLayout lists;
    uint32_t patches;
};

struct TargetPush {
    gpu::SeenLayout lists;
    uint32_t rays;
};

}  // namespace

/// As in face_ray.glsl.
struct FindClusterVisibility::RayPush {
    gpu::VoxelGrid grid;
    gpu::SeenLayout lists;
    uint32_t firstPatch;
    uint32_t rays;
    uint32_t seed;
    float nearDistance;
    uint32_t alongAxis;
    uint32_t round;
};

void FindClusterVisibility::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    clusters_ = builder.read<VoxelClusters>("clusters", "where voxels are");
    patches_ = builder.read<VoxelPatches>("patches", "surfaces by the open space that they look into");
    visibility_ = builder.write<ClusterVisibility>("cluster_visibility", "which clusters each patch sees");
}

void FindClusterVisibility::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    ClusterVisibility& visibility = plan.get(visibility_);
    const uint32_t chunk = kChunkRays / params_.rays;
    visibility.listsPatches = seesPatches();
    visibility.layout = {params_.rays, chunk, 0, uint32_t(std::bit_width(params_.rays - 1)), 32};
    const uint64_t patches = kPatchesPerVoxel * voxels.voxelCount, rays = uint64_t(chunk) * params_.rays;
    const double root = std::ceil(kSeenByRootOfRays * std::sqrt(double(params_.rays)));
    const uint64_t seen = seesPatches() ? params_.rays : std::min(params_.rays, uint32_t(root));
    listBytes_ = patches * (seen + 1) * sizeof(uint32_t);
    plan.reserveCounted("what patches see (estimated)", listBytes_);
    plan.reserveScratch("faces of patches (estimated)", patches * sizeof(uint32_t));
    plan.scratchBuffer(targets_, "targets of rays", rays * sizeof(uint32_t));
    plan.scratchBuffer(counts_, "targets of patches", (chunk + 1) * sizeof(uint32_t));
    plan.scratchBuffer(missed_, "rays that met nothing", 2 * sizeof(uint32_t));
    plan.reserveScratch("sums of lists", PrefixSum::scratchBytes(chunk + 1));
    const bool keeps = isExact() && !movingRuns(plan.frame.scene->geometry).empty();
    if (keeps)
        KeptRays::plan(plan, voxels, patches, params_.rays);
    else
        plan.scratchBuffer(met_, "what rays met", rays * sizeof(uint32_t));
    if (!isExact()) {
        march_.plan(plan, voxels);
        return;
    }
    const uint64_t words = (rays + 31) / 32;
    if (keeps) {
        plan.scratchBuffer(flags_, "rays to trace", words * sizeof(uint32_t));
        plan.reserveScratch("ranks of rays", Compaction::scratchBytes(uint32_t(words)));
    }
    plan.scratchBuffer(list_, "rays by number", rays * sizeof(uint32_t));
    plan.scratchBuffer(rays_, "rays of patches", rays * sizeof(Ray));
    plan.scratchBuffer(hits_, "hits of patches' rays", rays * sizeof(Hit));
    plan.scratchBuffer(proposals_, "what rays may have hit", rays * sizeof(Proposal));
    plan.scratchBuffer(between_, "rays from hits", rays * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility of hits", rays * sizeof(uint32_t));
}

void FindClusterVisibility::prepare(PassSetup& setup) {
    version_.reset();
    kept_.reset();
    prefixSum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
    const auto program = [&](const char* name, const Defines& defines = {}) {
        const std::string file = std::string("passes/cluster_visibility/") + name + ".comp";
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    listFaces_ = program("faces");
    targetsOf_ = program("targets");
    merge_ = program("merge");
    compact_ = program("compact");
    if (isExact()) {
        if (!movingRuns(setup.frame.scene->geometry).empty()) {
            compaction_.emplace(setup.device, setup.compiler);
            kept_.emplace(setup.device, setup.compiler);
        }
        all_ = program("all");
        emit_ = program("emit");
        choose_ = program("choose");
        return;
    }
    march_.prepare(setup.device, setup.compiler);
    Defines defines = march_.defines();
    if (params_.visibility == FaceRays::Bresenham) defines.emplace("BRESENHAM", "1");
    marchRays_ = program("march", defines);
}

void FindClusterVisibility::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    ClusterVisibility& visibility = context.get(visibility_);
    const std::pair version{voxels.version, patches.version};
    if (version_ == version) return;
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    const bool updates =
        kept_ && changed && version_ && version_->second + 1 == patches.version && patches.previousSides;
    version_ = version;
    ++visibility.version;
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
    if (!isExact()) march_.begin(stream, voxels);
    if (updates)
        kept_->begin(stream, voxels, context.get(clusters_), patches, *changed);
    else if (kept_)
        kept_->clear();
    const uint32_t count = patches.patchCount, perChunk = visibility.layout.patchesPerChunk;
    faces_ = Buffer(context.device, "faces of patches", std::max(count, 1u) * sizeof(uint32_t));
    stream.dispatch(listFaces_, {{"sides", patches.sides}, {"faces", faces_}}, patches.sideCount,
                    linearGroups(patches.sideCount));
    stream.fill(missed_, 0);
    traced_ = 0;
    for (uint32_t first = 0; first < count; first += perChunk)
        look(context, first, std::min(perChunk, count - first));
    faces_ = {};
    if (kept_) kept_->remember(stream, patches);
    if (!isExact()) context.voxelCounts.push_back(&march_.counts());

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

uint32_t FindClusterVisibility::listRays(PassContext& context, const RayPush& push, const Buffer& met) {
    CommandStream& stream = context.stream;
    if (!kept_ || !kept_->isActive()) {
        stream.dispatch(all_, {{"list", list_}}, push.rays, linearGroups(push.rays));
        return push.rays;
    }
    const VoxelPatches& patches = context.get(patches_);
    stream.fill(flags_, 0);
    kept_->keep(stream,
                context.scene.bindings({{"faces", faces_},
                                        {"sides", patches.sides},
                                        {"PatchSurfelsAt", patches.surfels.at()},
                                        {"met", met},
                                        {"flags", flags_}}),
                push, push.rays);
    return compaction_->run(stream, flags_, list_, (push.rays + 31) / 32);
}

uint32_t FindClusterVisibility::traceRays(PassContext& context, RayPush push, const Buffer& met) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    push.rays = listRays(context, push, met);
    if (push.rays == 0) return 0;
    stream.dispatch(emit_,
                    context.scene.bindings({{"faces", faces_},
                                            {"sides", patches.sides},
                                            {"PatchSurfelsAt", patches.surfels.at()},
                                            {"list", list_},
                                            {"rays", rays_}}),
                    push, linearGroups(push.rays));
    context.tracer.closestHit(stream, rays_, hits_, push.rays);
    for (push.round = 0; push.round <= kRounds; ++push.round) {
        stream.dispatch(choose_,
                        context.scene.bindings({{"faces", faces_},
                                                {"sides", patches.sides},
                                                {"firstSide", patches.firstSide},
                                                {"PatchSurfelsAt", patches.surfels.at()},
                                                {"VoxelMaterialsAt", patches.materials.at()},
                                                {"voxelOccupancy", voxels.occupancy},
                                                {"voxelRank", voxels.rank},
                                                {"list", list_},
                                                {"rays", rays_},
                                                {"hits", hits_},
                                                {"proposals", proposals_},
                                                {"between", between_},
                                                {"occluded", occluded_},
                                                {"met", met}}),
                        push, linearGroups(push.rays));
        if (push.round < kRounds) context.tracer.occluded(stream, between_, occluded_, push.rays);
    }
    return push.rays;
}

void FindClusterVisibility::marchRays(PassContext& context, const RayPush& push, const Buffer& met) {
    const VoxelPatches& patches = context.get(patches_);
    std::vector<Binding> bindings;
    for (const Binding& binding : march_.bindings()) bindings.push_back(ifUsed(binding));
    bindings.insert(bindings.end(), {{"faces", faces_},
                                     {"sides", patches.sides},
                                     {"firstSide", patches.firstSide},
                                     {"PatchSurfelsAt", patches.surfels.at()},
                                     {"VoxelMaterialsAt", patches.materials.at()},
                                     {"met", met}});
    context.stream.dispatch(marchRays_, bindings, push, linearGroups(push.rays));
}

void FindClusterVisibility::look(PassContext& context, uint32_t first, uint32_t count) {
    const VoxelPatches& patches = context.get(patches_);
    ClusterVisibility& visibility = context.get(visibility_);
    CommandStream& stream = context.stream;
    const RayPush push{context.get(voxels_).grid,
                       visibility.layout,
                       first,
                       count * params_.rays,
                       randomSeed(context.frame),
                       params_.nearDistance,
                       params_.hemisphere == FaceHemisphere::Face ? 1u : 0u,
                       0};
    const Buffer& met = kept_ ? kept_->add(context.device, push.rays) : met_;
    if (isExact())
        traced_ += traceRays(context, push, met);
    else
        marchRays(context, push, met);
    stream.dispatch(targetsOf_,
                    {{"met", met},
                     {"sides", patches.sides},
                     {"ofSide", patches.ofSide},
                     {"targets", targets_},
                     {"missed", missed_}},
                    TargetPush{visibility.layout, push.rays}, linearGroups(push.rays));

    // Merged by patch, and moved together
    const ListPush list{visibility.layout, count};
    stream.dispatch(merge_, {{"targets", targets_}, {"counts", counts_}}, list, linearGroups(count + 1));
    ClusterVisibility::Chunk chunk;
    chunk.first = Buffer(context.device, "where patches' lists begin", (count + 1) * sizeof(uint32_t));
    const uint32_t seen = prefixSum_->run(stream, counts_, chunk.first, count + 1);
    const uint64_t words = (uint64_t(seen) * visibility.layout.entryBits + 31) / 32;
    const uint64_t bytes = visibility.bytes() + (uint64_t(count) + 1 + words) * sizeof(uint32_t);
    const uint64_t most = listBytes_ + context.spareBytes;
    if (bytes > most)
        throw Error(
            "{}: what {} of {} patches see takes {:.1f} MiB, and the memory limit leaves {:.1f} MiB for all; "
            "lower 'rays', cluster_voxels's 'target' or voxelize's 'resolution', or raise the limit",
            kName, first + count, visibility.patchCount, double(bytes) / (1 << 20), double(most) / (1 << 20));
    chunk.seen = Buffer(context.device, "what patches see", std::max<uint64_t>(words, 1) * sizeof(uint32_t));
    stream.fill(chunk.seen, 0);
    stream.dispatch(compact_, {{"targets", targets_}, {"first", chunk.first}, {"seen", chunk.seen}}, list,
                    linearGroups(count));
    stream.finish();
    visibility.chunks.push_back(std::move(chunk));
    visibility.entries += seen;
}

}  // namespace voxray
