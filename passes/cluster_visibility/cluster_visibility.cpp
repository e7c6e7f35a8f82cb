#include "passes/cluster_visibility/cluster_visibility.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "trace/ray.h"

namespace voxray {
namespace {

constexpr uint32_t kChunkRays = 1u << 20;  // Bounds the rays in hand to 32 MiB.
constexpr uint32_t kRounds = 4;            // As in choose.comp.

/// As in choose.comp.
struct Proposal {
    uint32_t surfel;
    uint32_t hidden[kRounds];
};

struct ListPush {
    uint32_t faces;
    uint32_t raysPerFace;
};

}  // namespace

/// As in face_ray.glsl.
struct FindClusterVisibility::RayPush {
    gpu::VoxelGrid grid;
    uint32_t firstFace;
    uint32_t rays;
    uint32_t raysPerFace;
    uint32_t seed;
    float nearDistance;
    uint32_t sideTargets;
    uint32_t alongAxis;
    uint32_t round;
};

void FindClusterVisibility::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    patches_ = builder.read<VoxelPatches>("patches", "surfaces by the open space that they look into");
    visibility_ = builder.write<ClusterVisibility>("cluster_visibility", "which clusters each patch sees");
}

uint32_t FindClusterVisibility::chunkFaces() const {
    return kChunkRays / params_.rays;
}

void FindClusterVisibility::plan(PassPlan& plan) {
    const SurfaceVoxels& voxels = plan.get(voxels_);
    ClusterVisibility& visibility = plan.get(visibility_);
    visibility.rays = params_.rays;
    visibility.seesVoxels = params_.nearDistance > 0;
    march_.plan(plan, voxels);
    const uint64_t faces = kSidesPerVoxel * voxels.voxelCount * kFaces;
    const uint64_t chunk = chunkFaces(), rays = chunk * params_.rays;
    plan.reserve("what faces see (at most)", faces * (params_.rays + 2) * sizeof(uint32_t));
    plan.reserveScratch("patches (estimated)", faces * sizeof(uint32_t));
    plan.scratchBuffer(targets_, "targets of rays", rays * sizeof(uint32_t));
    plan.scratchBuffer(counts_, "targets of faces", (chunk + 1) * sizeof(uint32_t));
    plan.scratchBuffer(missed_, "rays that met nothing", 2 * sizeof(uint32_t));
    plan.reserveScratch("lists of faces (estimated)", faces / 8 +
                                                          Compaction::scratchBytes(uint32_t(faces / 32 + 1)) +
                                                          PrefixSum::scratchBytes(uint32_t(chunk) + 1));
    if (params_.visibility == FaceRays::Exact) {
        plan.scratchBuffer(rays_, "rays of faces", rays * sizeof(Ray));
        plan.scratchBuffer(hits_, "hits of faces' rays", rays * sizeof(Hit));
        plan.scratchBuffer(proposals_, "what rays may have hit", rays * sizeof(Proposal));
        plan.scratchBuffer(between_, "rays from hits", rays * sizeof(Ray));
        plan.scratchBuffer(occluded_, "visibility of hits", rays * sizeof(uint32_t));
    }
}

void FindClusterVisibility::prepare(PassSetup& setup) {
    version_.reset();
    march_.prepare(setup.device, setup.compiler);
    compaction_.emplace(setup.device, setup.compiler);
    prefixSum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
    const auto program = [&](const char* name, const Defines& defines = {}) {
        const std::string file = std::string("passes/cluster_visibility/") + name + ".comp";
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    faceBits_ = program("faces");
    merge_ = program("merge");
    compact_ = program("compact");
    if (params_.visibility == FaceRays::Exact) {
        emit_ = program("emit");
        choose_ = program("choose");
    } else {
        Defines defines = march_.defines();
        if (params_.visibility == FaceRays::Bresenham) defines.emplace("BRESENHAM", "1");
        marchRays_ = program("march", defines);
    }
}

void FindClusterVisibility::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    ClusterVisibility& visibility = context.get(visibility_);
    const std::pair version{voxels.version, patches.version};
    if (version_ == version) return;
    version_ = version;
    ++visibility.version;
    visibility.chunks.clear();
    visibility.sideTargets = kFaces * patches.partCount;
    const uint64_t all = uint64_t(kFaces) * patches.sideCount;
    const uint64_t targets = visibility.sideTargets + (visibility.seesVoxels ? all : 0);
    if (targets > SEEN_MAX_TARGETS)
        throw Error(
            "{}: {} faces of clusters and voxels don't fit into 22 bits; set 'near_distance: 0' or lower "
            "voxelize's 'resolution'",
            kName, targets);

    // Faces that anything can arrive at
    CommandStream& stream = context.stream;
    march_.begin(stream, voxels);
    const uint32_t words = uint32_t((all + 31) / 32);
    const Buffer flags(context.device, "patches", std::max(words, 1u) * sizeof(uint32_t));
    stream.dispatch(faceBits_, {{"VoxelMaterialsAt", patches.materials.at()}, {"flags", flags}},
                    uint32_t(all), linearGroups(words));
    faces_ = Buffer(context.device, "patches", std::max<uint64_t>(all, 1) * sizeof(uint32_t));
    const uint32_t faces = compaction_->run(stream, flags, faces_, words);

    stream.fill(missed_, 0);
    for (uint32_t first = 0; first < faces; first += chunkFaces())
        look(context, first, std::min(chunkFaces(), faces - first));
    faces_ = {};
    context.voxelCounts.push_back(&march_.counts());

    uint64_t seen = 0;
    for (const ClusterVisibility::Chunk& chunk : visibility.chunks)
        seen += chunk.seen.bytes() / sizeof(uint32_t);
    const double rays = double(faces) * params_.rays;
    const std::vector<uint32_t> missed = stream.readAs<uint32_t>(missed_, 2);
    const auto percent = [&](uint32_t count) { return faces > 0 ? 100 * count / rays : 0; };
    context.report("faces with surfaces", faces);
    context.report("clusters and voxels seen by a face", faces > 0 ? double(seen) / faces : 0);
    context.report("rays that met nothing, %", percent(missed[0]));
    context.report("hits without surfel, % of rays", percent(missed[1]));
    context.report("bytes of the lists", double(visibility.bytes()));
}

void FindClusterVisibility::traceRays(PassContext& context, RayPush push) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    stream.dispatch(emit_,
                    {{"faces", faces_},
                     {"sides", patches.sides},
                     {"PatchSurfelsAt", patches.surfels.at()},
                     {"rays", rays_}},
                    push, linearGroups(push.rays));
    context.tracer.closestHit(stream, rays_, hits_, push.rays);
    for (push.round = 0; push.round <= kRounds; ++push.round) {
        stream.dispatch(choose_,
                        context.scene.bindings({{"faces", faces_},
                                                {"sides", patches.sides},
                                                {"ofSide", patches.ofSide},
                                                {"firstSide", patches.firstSide},
                                                {"PatchSurfelsAt", patches.surfels.at()},
                                                {"VoxelMaterialsAt", patches.materials.at()},
                                                {"voxelOccupancy", voxels.occupancy},
                                                {"voxelRank", voxels.rank},
                                                {"rays", rays_},
                                                {"hits", hits_},
                                                {"proposals", proposals_},
                                                {"between", between_},
                                                {"occluded", occluded_},
                                                {"targets", targets_},
                                                {"missed", missed_}}),
                        push, linearGroups(push.rays));
        if (push.round < kRounds) context.tracer.occluded(stream, between_, occluded_, push.rays);
    }
}

void FindClusterVisibility::marchRays(PassContext& context, const RayPush& push) {
    const VoxelPatches& patches = context.get(patches_);
    std::vector<Binding> bindings;
    for (const Binding& binding : march_.bindings()) bindings.push_back(ifUsed(binding));
    bindings.insert(bindings.end(), {{"faces", faces_},
                                     {"sides", patches.sides},
                                     {"ofSide", patches.ofSide},
                                     {"firstSide", patches.firstSide},
                                     {"PatchSurfelsAt", patches.surfels.at()},
                                     {"VoxelMaterialsAt", patches.materials.at()},
                                     {"targets", targets_},
                                     {"missed", missed_}});
    context.stream.dispatch(marchRays_, bindings, push, linearGroups(push.rays));
}

void FindClusterVisibility::look(PassContext& context, uint32_t first, uint32_t count) {
    ClusterVisibility& visibility = context.get(visibility_);
    CommandStream& stream = context.stream;
    const RayPush push{context.get(voxels_).grid,
                       first,
                       count * params_.rays,
                       params_.rays,
                       randomSeed(context.frame),
                       params_.nearDistance,
                       visibility.sideTargets,
                       params_.hemisphere == FaceHemisphere::Face ? 1u : 0u,
                       0};
    if (params_.visibility == FaceRays::Exact)
        traceRays(context, push);
    else
        marchRays(context, push);

    // Merged by face, and moved together
    const ListPush list{count, params_.rays};
    stream.dispatch(merge_, {{"targets", targets_}, {"counts", counts_}}, list, linearGroups(count + 1));
    ClusterVisibility::Chunk chunk;
    chunk.count = count;
    chunk.faces = Buffer(context.device, "faces that see", count * sizeof(uint32_t));
    chunk.first = Buffer(context.device, "where faces' lists begin", (count + 1) * sizeof(uint32_t));
    stream.copy(faces_, chunk.faces, count * sizeof(uint32_t), first * sizeof(uint32_t));
    const uint32_t seen = prefixSum_->run(stream, counts_, chunk.first, count + 1);
    chunk.seen = Buffer(context.device, "what faces see", std::max(seen, 1u) * sizeof(uint32_t));
    stream.dispatch(compact_, {{"targets", targets_}, {"first", chunk.first}, {"seen", chunk.seen}}, list,
                    linearGroups(count));
    stream.finish();
    visibility.chunks.push_back(std::move(chunk));
}

}  // namespace voxray
