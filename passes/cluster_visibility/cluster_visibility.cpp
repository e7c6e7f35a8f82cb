#include "passes/cluster_visibility/cluster_visibility.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"
#include "trace/ray.h"

namespace voxray {
namespace {

constexpr uint32_t kChunkRays = 1u << 22;  // Bounds the targets in hand to 16 MiB.

/// As in face_ray.glsl.
struct RayPush {
    gpu::VoxelGrid grid;
    uint32_t firstFace;
    uint32_t rays;
    uint32_t raysPerFace;
    uint32_t seed;
    float nearDistance;
    uint32_t voxelTargets;
    uint32_t alongAxis;
};

struct ListPush {
    uint32_t faces;
    uint32_t raysPerFace;
};

}  // namespace

void FindClusterVisibility::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    clusters_ = builder.read<VoxelClusters>("clusters", "surface voxels in groups");
    visibility_ = builder.write<ClusterVisibility>("cluster_visibility", "which clusters each face sees");
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
    const uint64_t faces = uint64_t(voxels.voxelCount) * kFaces;
    const uint64_t chunk = std::min<uint64_t>(chunkFaces(), faces), rays = chunk * params_.rays;
    plan.reserve("what faces see (at most)", faces * (params_.rays + 2) * sizeof(uint32_t));
    plan.scratchBuffer(faces_, "faces with surfaces", faces * sizeof(uint32_t) + (faces / 16 + 1024));
    plan.scratchBuffer(targets_, "targets of rays", rays * sizeof(uint32_t));
    plan.scratchBuffer(counts_, "targets of faces", (chunk + 1) * sizeof(uint32_t));
    plan.scratchBuffer(missed_, "rays that met nothing", sizeof(uint32_t));
    plan.reserveScratch("lists of faces (estimated)", faces / 8 +
                                                          Compaction::scratchBytes(uint32_t(faces / 32 + 1)) +
                                                          PrefixSum::scratchBytes(uint32_t(chunk) + 1));
    if (params_.visibility == FaceRays::Exact) {
        plan.scratchBuffer(rays_, "rays of faces", rays * sizeof(Ray));
        plan.scratchBuffer(hits_, "hits of faces' rays", rays * sizeof(Hit));
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
        place_ = program("exact_place");
        aim_ = program("exact_aim");
        see_ = program("exact_see");
    } else {
        marchRays_ = program("march", march_.defines());
    }
}

void FindClusterVisibility::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelClusters& clusters = context.get(clusters_);
    ClusterVisibility& visibility = context.get(visibility_);
    const std::pair version{voxels.version, clusters.version};
    if (version_ == version) return;
    version_ = version;
    ++visibility.version;
    visibility.chunks.clear();
    visibility.voxelTargets = kFaces * clusters.count;
    const uint64_t all = uint64_t(kFaces) * voxels.voxelCount;
    const uint64_t targets = visibility.voxelTargets + (visibility.seesVoxels ? all : 0);
    if (targets > SEEN_MAX_TARGETS)
        throw Error(
            "{}: {} faces of clusters and voxels don't fit into 22 bits; set 'near_distance: 0' or lower "
            "voxelize's 'resolution'",
            kName, targets);

    // Faces that anything can arrive at
    CommandStream& stream = context.stream;
    march_.begin(stream, voxels);
    const uint32_t words = uint32_t((all + 31) / 32);
    const Buffer flags(context.device, "faces with surfaces", words * sizeof(uint32_t));
    stream.dispatch(faceBits_, voxels.bindings({{"flags", flags}}), uint32_t(all), linearGroups(words));
    const uint32_t faces = compaction_->run(stream, flags, faces_, words);

    stream.fill(missed_, 0);
    for (uint32_t first = 0; first < faces; first += chunkFaces())
        look(context, first, std::min(chunkFaces(), faces - first));
    context.voxelCounts.push_back(&march_.counts());

    uint64_t seen = 0;
    for (const ClusterVisibility::Chunk& chunk : visibility.chunks)
        seen += chunk.seen.bytes() / sizeof(uint32_t);
    const double rays = double(faces) * params_.rays;
    context.report("faces with surfaces", faces);
    context.report("clusters and voxels seen by a face", faces > 0 ? double(seen) / faces : 0);
    context.report("rays that met nothing, %",
                   faces > 0 ? 100 * stream.readAs<uint32_t>(missed_, 1)[0] / rays : 0);
    context.report("bytes of the lists", double(visibility.bytes()));
}

void FindClusterVisibility::look(PassContext& context, uint32_t first, uint32_t count) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelClusters& clusters = context.get(clusters_);
    ClusterVisibility& visibility = context.get(visibility_);
    CommandStream& stream = context.stream;
    const uint32_t rays = count * params_.rays;
    const RayPush push{voxels.grid,
                       first,
                       rays,
                       params_.rays,
                       randomSeed(context.frame),
                       params_.nearDistance,
                       visibility.voxelTargets,
                       params_.hemisphere == FaceHemisphere::Face ? 1u : 0u};
    const std::vector<Binding> shared = {{"faces", faces_},
                                         ifUsed({"coordinates", clusters.coordinates}),
                                         ifUsed({"ofVoxel", clusters.ofVoxel}),
                                         ifUsed({"VoxelMaterialsAt", voxels.materials.at()})};
    const auto with = [&](std::vector<Binding> bindings, std::initializer_list<Binding> more) {
        bindings.insert(bindings.end(), shared.begin(), shared.end());
        bindings.insert(bindings.end(), more.begin(), more.end());
        return bindings;
    };

    // Targets of all rays
    if (params_.visibility == FaceRays::Voxels) {
        stream.dispatch(marchRays_, with(march_.bindings(), {{"targets", targets_}, {"missed", missed_}}),
                        push, linearGroups(rays));
    } else {
        stream.dispatch(place_, with({}, {{"rays", rays_}}), push, linearGroups(rays));
        context.tracer.closestHit(stream, rays_, hits_, rays);
        stream.dispatch(aim_, with(context.scene.bindings({}), {{"rays", rays_}, {"hits", hits_}}), push,
                        linearGroups(rays));
        context.tracer.closestHit(stream, rays_, hits_, rays);
        stream.dispatch(see_,
                        with(context.scene.bindings({ifUsed({"voxelOccupancy", voxels.occupancy}),
                                                     ifUsed({"voxelRank", voxels.rank})}),
                             {{"rays", rays_}, {"hits", hits_}, {"targets", targets_}, {"missed", missed_}}),
                        push, linearGroups(rays));
    }

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
