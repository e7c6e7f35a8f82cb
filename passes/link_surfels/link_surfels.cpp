#include "passes/link_surfels/link_surfels.h"

#include <algorithm>
#include <limits>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/random_seed.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;
constexpr uint64_t kPackedSurfelBytes = 2 * sizeof(uint32_t);

struct PackPush {
    gpu::VoxelGrid grid;
    uint32_t voxels;
};

struct EmitPush {
    uint32_t firstSurfel;
    uint32_t rayCount;
    uint32_t raysPerSurfel;
    uint32_t seed;
};

struct ProbePush {
    uint32_t rayCount;
    float voxelSize;
};

struct LinkPush {
    gpu::VoxelGrid grid;
    uint32_t firstNumber;
    uint32_t rayCount;
    uint32_t raysPerSurfel;
    uint32_t surfelCount;
};

struct DistancePush {
    uint32_t firstNumber;
    uint32_t surfelCount;
    uint32_t raysPerSurfel;
    float voxelSize;
};

}  // namespace

void LinkSurfels::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels, by which surfels are found");
    surfels_ = builder.read<Surfels>("surfels", "points to link");
    links_ = builder.write<SurfelLinks>("links", "which surfels each surfel sees");
    byVoxel_ = builder.write<SurfelsByVoxel>("surfels_by_voxel", "the surfels of each voxel");
    neighbours_ = builder.write<SurfelNeighbours>("neighbours", "the surfels around each surfel");
}

void LinkSurfels::plan(PassPlan& plan) {
    const uint64_t surfels = plan.get(surfels_).maxCount, voxels = plan.get(voxels_).voxelCount;
    plan.get(links_).raysPerSurfel = params_.raysPerSurfel;
    plan.reserve("surfel links (estimated)", surfels * params_.raysPerSurfel * sizeof(uint32_t));
    plan.reserve("packed surfels (estimated)", surfels * kPackedSurfelBytes);
    plan.reserveScratch("inverse distances of surfels (estimated)", surfels * sizeof(float));
    plan.scratchBuffer(rays_, "link rays", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(hits_, "link hits", uint64_t(kBatchRays) * sizeof(Hit));
    plan.scratchBuffer(probes_, "rays that tell covered hits", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(covered_, "link hits on covered sides", uint64_t(kBatchRays) * sizeof(uint32_t));
    plan.scratchBuffer(unlinked_, "number of hits without surfel", sizeof(uint32_t));
    SurfelSort::plan(plan, plan.get(surfels_), voxels, plan.get(byVoxel_));
    plan.get(byVoxel_).coveredSides = plan.get(surfels_).coveredSides;
    if (plan.get(neighbours_).isRead)
        NeighbourSearch::plan(plan, plan.get(byVoxel_), voxels, plan.get(neighbours_));
}

void LinkSurfels::prepare(PassSetup& setup) {
    const auto program = [&](const char* file) {
        return makeComputeProgram(setup.device, setup.compiler.compile(file));
    };
    sort_.prepare(setup);
    neighbourSearch_.prepare(setup);
    pack_ = program("passes/link_surfels/pack.comp");
    emit_ = program("passes/link_surfels/emit.comp");
    probe_ = program("passes/link_surfels/probe.comp");
    link_ = program("passes/link_surfels/link.comp");
    distance_ = program("passes/link_surfels/inverse_distance.comp");
    packDistance_ = program("passes/link_surfels/pack_distance.comp");
}

void LinkSurfels::record(PassContext& context) {
    SurfelLinks& links = context.get(links_);
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (changed && changed->empty() && links.links) return;  // Light alone has changed.

    const Surfels& surfels = context.get(surfels_);
    uint64_t count = 0;
    for (const Surfels::Chunk& chunk : surfels.chunks) count += chunk.count;
    if (count * params_.raysPerSurfel >= std::numeric_limits<uint32_t>::max())
        throw Error(
            "{}: {} surfels with {} rays each are more links than can be numbered (2^32); lower "
            "'rays_per_surfel', "
            "or place_surfels's 'points_per_voxel'",
            kName, count, params_.raysPerSurfel);
    links.surfelCount = uint32_t(count);
    links.links = {};
    links.links =
        LargeBuffer(context.device, "surfel links", count * params_.raysPerSurfel * sizeof(uint32_t));

    sort_.run(context.stream, surfels, context.get(voxels_).voxelCount, context.get(byVoxel_));
    pack(context);
    const LargeBuffer inverseDistances(context.device, "inverse distances of surfels",
                                       std::max(context.get(byVoxel_).slotCount, 1u) * sizeof(float));
    context.stream.fill(unlinked_, 0);
    uint32_t first = 0;
    for (const Surfels::Chunk& chunk : surfels.chunks) {
        link(context, chunk, first, links, inverseDistances);
        first += chunk.count;
    }
    packDistance(context, inverseDistances);
    if (context.get(neighbours_).isRead)
        context.report("radius of neighbours, voxels",
                       neighbourSearch_.run(context.stream, context.get(voxels_), context.get(byVoxel_),
                                            context.get(neighbours_)));
    const uint32_t unlinked = context.stream.readAs<uint32_t>(unlinked_, 1)[0];
    context.report("links", double(count) * params_.raysPerSurfel);
    context.report("hits without surfel, % of rays",
                   100.0 * unlinked / (double(count) * params_.raysPerSurfel));
}

void LinkSurfels::pack(PassContext& context) const {
    const SurfaceVoxels& voxels = context.get(voxels_);
    SurfelsByVoxel& byVoxel = context.get(byVoxel_);
    byVoxel.packed = {};
    byVoxel.packed =
        LargeBuffer(context.device, "packed surfels", std::max(byVoxel.slotCount, 1u) * kPackedSurfelBytes);
    context.stream.dispatch(
        pack_,
        voxels.bindings(
            {{"SortedAt", byVoxel.sorted.at()}, {"PackedAt", byVoxel.packed.at()}, {"lists", byVoxel.lists}}),
        PackPush{voxels.grid, voxels.voxelCount}, linearGroups(voxels.voxelCount));
}

void LinkSurfels::link(PassContext& context, const Surfels::Chunk& chunk, uint32_t first, SurfelLinks& links,
                       const LargeBuffer& inverseDistances) const {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const SurfelsByVoxel& byVoxel = context.get(byVoxel_);
    const bool probe = context.get(surfels_).coveredSides;
    if (!probe) context.stream.fill(covered_, 0);
    const uint32_t perSurfel = params_.raysPerSurfel, batch = kBatchRays / perSurfel;
    for (uint32_t begin = 0; begin < chunk.count; begin += batch) {
        const uint32_t rays = std::min(batch, chunk.count - begin) * perSurfel;
        context.stream.dispatch(emit_, context.scene.bindings({{"surfels", chunk.surfels}, {"rays", rays_}}),
                                EmitPush{begin, rays, perSurfel, randomSeed(context.frame)},
                                linearGroups(rays));
        context.tracer.closestHit(context.stream, rays_, hits_, rays);
        if (probe) {
            context.stream.dispatch(
                probe_, context.scene.bindings({{"rays", rays_}, {"hits", hits_}, {"probes", probes_}}),
                ProbePush{rays, voxels.grid.voxelSize}, linearGroups(rays));
            context.tracer.occluded(context.stream, probes_, covered_, rays);
        }
        context.stream.dispatch(link_,
                                voxels.bindings(context.scene.bindings({{"rays", rays_},
                                                                        {"hits", hits_},
                                                                        {"covered", covered_},
                                                                        {"SortedAt", byVoxel.sorted.at()},
                                                                        {"lists", byVoxel.lists},
                                                                        {"LinksAt", links.links.at()},
                                                                        {"unlinked", unlinked_}})),
                                LinkPush{voxels.grid, first + begin, rays, perSurfel, links.surfelCount},
                                linearGroups(rays));
        context.stream.dispatch(
            distance_,
            {{"hits", hits_}, {"SlotsAt", byVoxel.slots.at()}, {"InverseDistancesAt", inverseDistances.at()}},
            DistancePush{first + begin, rays / perSurfel, perSurfel, voxels.grid.voxelSize},
            linearGroups(rays / perSurfel));
    }
    context.stream.finish();
}

void LinkSurfels::packDistance(PassContext& context, const LargeBuffer& inverseDistances) const {
    const SurfelsByVoxel& byVoxel = context.get(byVoxel_);
    const uint32_t voxels = context.get(voxels_).voxelCount;
    context.stream.dispatch(packDistance_,
                            {{"InverseDistancesAt", inverseDistances.at()},
                             {"PackedAt", byVoxel.packed.at()},
                             {"lists", byVoxel.lists}},
                            voxels, linearGroups(voxels));
    context.stream.finish();
}

}  // namespace voxray
