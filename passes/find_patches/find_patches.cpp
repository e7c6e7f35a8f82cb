#include "passes/find_patches/find_patches.h"

#include <algorithm>
#include <bit>

#include "base/error.h"
#include "passes/common/compute/dispatch.h"
#include "trace/ray.h"

namespace voxray {
namespace {

constexpr uint32_t kBatchRays = 1u << 20;
/// Of a voxel, open or covered: what is left is on the last one.
constexpr uint32_t kMaxSides = 8;
/// Of a side, in the mean: two layers of the voxels round it.
constexpr uint64_t kNeighbours = 18;

struct ChunkPush {
    gpu::VoxelGrid grid;
    uint32_t count;
    uint32_t firstNumber;
};

struct AcrossPush {
    uint32_t first;
    uint32_t count;
    float voxelSize;
};

struct PivotPush {
    uint32_t voxels;
    uint32_t round;
    uint32_t isCovered;
};

struct AimPush {
    uint32_t first;
    uint32_t count;
    uint32_t isCovered;
};

struct JoinPush {
    uint32_t first;
    uint32_t count;
    uint32_t round;
    uint32_t isLast;
    uint32_t isCovered;
};

struct NearPush {
    gpu::VoxelGrid grid;
    uint32_t sides;
};

struct PairPush {
    uint32_t first;
    uint32_t count;
};

struct AssignPush {
    uint32_t sides;
    uint32_t parts;
};

/// Calls f with the first and the number of each batch of rays.
template <class F>
void inBatches(uint32_t count, F f) {
    for (uint32_t first = 0; first < count; first += kBatchRays)
        f(first, std::min(kBatchRays, count - first));
}

uint64_t uints(uint64_t count) {
    return std::max<uint64_t>(count, 1) * sizeof(uint32_t);
}

}  // namespace

void FindPatches::declare(PassBuilder& builder) {
    voxels_ = builder.read<SurfaceVoxels>("voxels", "surface voxels");
    surfels_ = builder.read<Surfels>("surfels", "points of their surfaces");
    clusters_ = builder.read<VoxelClusters>("clusters", "surface voxels in groups");
    patches_ = builder.write<VoxelPatches>("patches", "surfaces by the open space that they look into");
}

void FindPatches::plan(PassPlan& plan) {
    const uint64_t voxels = plan.get(voxels_).voxelCount, surfels = plan.get(surfels_).maxCount;
    const uint64_t sides = kSidesPerVoxel * voxels, pairs = kNeighbours * sides;
    SurfelsByVoxel lists;
    SurfelSort::plan(plan, plan.get(surfels_), voxels, lists);
    plan.reserve("surfels by side (estimated)", surfels * sizeof(gpu::PatchSurfel) + uints(surfels));
    plan.reserve(
        "sides of voxels (estimated)",
        sides * (sizeof(gpu::SurfaceSide) + sizeof(gpu::PackedVoxelMaterial)) + uints(voxels + sides));
    plan.reserve("neighbours of sides (estimated)", uints(pairs));
    plan.reserve("parts of clusters (estimated)", sides * sizeof(gpu::ClusterPart) + 2 * uints(sides));
    plan.reserveScratch("search of parts (estimated)",
                        uints(pairs) + 8 * uints(sides) + RadixSort::scratchBytes(uint32_t(sides)));
    plan.scratchBuffer(rays_, "rays between surfels", uint64_t(kBatchRays) * sizeof(Ray));
    plan.scratchBuffer(occluded_, "visibility of surfels", uint64_t(kBatchRays) * sizeof(uint32_t));
    if (plan.get(surfels_).coveredSides)
        plan.scratchBuffer(hits_, "gaps before surfels", uint64_t(kBatchRays) * sizeof(Hit));
    plan.scratchBuffer(counter_, "what is left", sizeof(uint32_t));
    if (!movingRuns(plan.frame.scene->geometry).empty())
        KeptSides::plan(plan, plan.get(voxels_), surfels, sides, pairs);
}

void FindPatches::prepare(PassSetup& setup) {
    version_.reset();
    kept_.reset();
    sort_.prepare(setup);
    prefixSum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
    compaction_.emplace(setup.device, setup.compiler);
    histogram_.emplace(setup.device, setup.compiler);
    radixSort_.emplace(setup.device, setup.compiler);
    const auto program = [&](const char* name, const Defines& defines = {}) {
        const std::string file = std::string("passes/find_patches/") + name + ".comp";
        return makeComputeProgram(setup.device, setup.compiler.compile(file, defines));
    };
    if (!movingRuns(setup.frame.scene->geometry).empty()) {
        const Defines keep{{"KEEP", "1"}};
        kept_.emplace(setup.device, setup.compiler);
        beginKept_ = program("begin", keep);
        aimNearKept_ = program("aim_near", keep);
        partNearKept_ = program("part_near", keep);
    }
    begin_ = program("begin");
    aimAcross_ = program("aim_across");
    raise_ = program("raise");
    pivot_ = program("pivot");
    aim_ = program("aim");
    join_ = program("join");
    order_ = program("order");
    list_ = program("list");
    describe_ = program("describe");
    numberPatches_ = program("number_patches");
    countNear_ = program("near");
    listNear_ = program("near", {{"LIST", "1"}});
    aimNear_ = program("aim_near");
    partNear_ = program("part_near");
    label_ = program("label");
    spread_ = program("spread");
    flag_ = program("flag");
    number_ = program("number");
    assign_ = program("assign");
    parts_ = program("parts");
}

void FindPatches::record(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const std::pair version{voxels.version, context.get(clusters_).version};
    if (version_ == version) return;
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    const bool updates = kept_ && changed && version_ && version_->first + 1 == voxels.version;
    version_ = version;
    if (!voxels.unoccludedOnly)
        throw Error(
            "{}: surfels without open space before them have no side; leave voxelize's 'visibility_rays' "
            "above 0",
            kName);
    VoxelPatches& patches = context.get(patches_);
    ++patches.version;
    if (updates) kept_->begin(context.stream, voxels, patches, *changed);
    patches.clear();
    SurfelsByVoxel lists;
    sort_.run(context.stream, context.get(surfels_), voxels.voxelCount, lists);
    findSides(context, lists);
    listSides(context, lists);
    lists = {};
    findNeighbours(context);
    findParts(context);
    if (kept_) kept_->end();
    if (kept_) kept_->rememberVoxels(context.stream, voxels);
    context.report("sides of voxels", patches.sideCount);
    context.report("sides for each voxel", double(patches.sideCount) / voxels.voxelCount);
    context.report("patches for each voxel", double(patches.patchCount) / voxels.voxelCount);
    context.report("parts of clusters", patches.partCount);
    context.report("bytes of sides", double(patches.bytes()));
}

void FindPatches::findSides(PassContext& context, SurfelsByVoxel& lists) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    patches.surfelCount = lists.slotCount;
    patches.surfels = LargeBuffer(context.device, "surfels by side",
                                  std::max(lists.slotCount, 1u) * sizeof(gpu::PatchSurfel));
    uint32_t number = 0;
    for (const Surfels::Chunk& chunk : context.get(surfels_).chunks) {
        const std::vector<Binding> bindings{{"surfels", chunk.surfels},
                                            {"SlotsAt", lists.slots.at()},
                                            {"PatchSurfelsAt", patches.surfels.at()}};
        stream.dispatch(isUpdate() ? beginKept_ : begin_,
                        isUpdate() ? kept_->surfelBindings(context.get(clusters_), bindings) : bindings,
                        ChunkPush{voxels.grid, chunk.count, number}, linearGroups(chunk.count));
        number += chunk.count;
    }
    stream.finish();
    patches.places = std::move(lists.slots);
    lists.sorted = {};
    splitByRays(context, lists, 0);
    if (context.get(surfels_).coveredSides) {
        raiseCovered(context);
        splitByRays(context, lists, 1);
    }
    if (kept_) kept_->rememberSurfels(stream, patches, context.get(surfels_).maxCount);
}

void FindPatches::raiseCovered(PassContext& context) {
    const float voxelSize = context.get(voxels_).grid.voxelSize;
    const VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    inBatches(patches.surfelCount, [&](uint32_t first, uint32_t count) {
        stream.dispatch(aimAcross_,
                        context.scene.bindings({{"rays", rays_}, {"PatchSurfelsAt", patches.surfels.at()}}),
                        AcrossPush{first, count, voxelSize}, linearGroups(count));
        context.tracer.closestHit(stream, rays_, hits_, count);
        stream.dispatch(raise_, {{"hits", hits_}, {"PatchSurfelsAt", patches.surfels.at()}},
                        PairPush{first, count}, linearGroups(count));
    });
}

void FindPatches::splitByRays(PassContext& context, const SurfelsByVoxel& lists, uint32_t isCovered) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    const VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    const Buffer pivots(context.device, "surfels that began sides", uints(voxels.voxelCount));
    for (uint32_t i = 0; i < kMaxSides; ++i) {
        const uint32_t round = isCovered * kMaxSides + i;
        stream.fill(counter_, 0);
        stream.dispatch(pivot_,
                        {{"lists", lists.lists},
                         {"pivots", pivots},
                         {"left", counter_},
                         {"PatchSurfelsAt", patches.surfels.at()}},
                        PivotPush{voxels.voxelCount, round, isCovered}, linearGroups(voxels.voxelCount));
        if (stream.readAs<uint32_t>(counter_, 1)[0] == 0) break;
        inBatches(patches.surfelCount, [&](uint32_t first, uint32_t count) {
            stream.dispatch(aim_,
                            {{"pivots", pivots}, {"rays", rays_}, {"PatchSurfelsAt", patches.surfels.at()}},
                            AimPush{first, count, isCovered}, linearGroups(count));
            context.tracer.occluded(stream, rays_, occluded_, count);
            stream.dispatch(join_, {{"occluded", occluded_}, {"PatchSurfelsAt", patches.surfels.at()}},
                            JoinPush{first, count, round, i + 1 == kMaxSides ? 1u : 0u, isCovered},
                            linearGroups(count));
        });
    }
    stream.finish();
}

void FindPatches::listSides(PassContext& context, const SurfelsByVoxel& lists) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    const uint32_t count = voxels.voxelCount;
    patches.firstSide = Buffer(context.device, "first side by voxel", uints(count + 1));
    stream.dispatch(
        order_,
        {{"lists", lists.lists}, {"counts", patches.firstSide}, {"PatchSurfelsAt", patches.surfels.at()}},
        count, linearGroups(count + 1));
    patches.sideCount = prefixSum_->run(stream, patches.firstSide, patches.firstSide, count + 1);
    const uint64_t sides = std::max(patches.sideCount, 1u);
    patches.sides = Buffer(context.device, "sides of voxels", sides * sizeof(gpu::SurfaceSide));
    patches.materials =
        LargeBuffer(context.device, "materials of sides", sides * sizeof(gpu::PackedVoxelMaterial));
    stream.dispatch(list_,
                    {{"lists", lists.lists},
                     {"firstSide", patches.firstSide},
                     {"PlacesAt", patches.places.at()},
                     {"sides", patches.sides},
                     {"PatchSurfelsAt", patches.surfels.at()}},
                    count, linearGroups(count));
    const Buffer counts(context.device, "patches of sides", uints(sides));
    stream.dispatch(describe_,
                    {{"VoxelMaterialsAt", voxels.materials.at()},
                     {"sides", patches.sides},
                     {"firstSide", patches.firstSide},
                     {"SideMaterialsAt", patches.materials.at()},
                     {"counts", counts},
                     {"PatchSurfelsAt", patches.surfels.at()}},
                    count, linearGroups(count));
    patches.patchCount = prefixSum_->run(stream, counts, counts, patches.sideCount);
    stream.dispatch(numberPatches_, {{"before", counts}, {"sides", patches.sides}}, patches.sideCount,
                    linearGroups(patches.sideCount));
    if (isUpdate()) kept_->findPrevious(stream, voxels, context.get(clusters_), patches);
    stream.finish();
}

void FindPatches::findNeighbours(PassContext& context) {
    const SurfaceVoxels& voxels = context.get(voxels_);
    VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    const uint32_t sides = patches.sideCount;
    const NearPush push{voxels.grid, sides};
    const auto shared = [&](std::initializer_list<Binding> more) {
        std::vector<Binding> bindings = {{"coordinates", context.get(clusters_).coordinates},
                                         {"sides", patches.sides},
                                         {"firstSide", patches.firstSide},
                                         {"SideMaterialsAt", patches.materials.at()}};
        bindings.insert(bindings.end(), more.begin(), more.end());
        return voxels.bindings(bindings);
    };
    patches.firstNeighbour = Buffer(context.device, "first neighbour of each side", uints(sides + 1));
    stream.dispatch(countNear_, shared({{"counts", patches.firstNeighbour}}), push, linearGroups(sides + 1));
    const uint32_t pairs = prefixSum_->run(stream, patches.firstNeighbour, patches.firstNeighbour, sides + 1);
    patches.neighbours = LargeBuffer(context.device, "neighbours of sides", uints(pairs));
    const LargeBuffer whose(context.device, "whose neighbours", uints(pairs));
    stream.dispatch(listNear_,
                    shared({{"firstNeighbour", patches.firstNeighbour},
                            {"NeighboursAt", patches.neighbours.at()},
                            {"WhoseAt", whose.at()}}),
                    push, linearGroups(sides + 1));
    inBatches(pairs, [&](uint32_t first, uint32_t count) {
        const std::vector<Binding> aimed{{"sides", patches.sides},
                                         {"NeighboursAt", patches.neighbours.at()},
                                         {"WhoseAt", whose.at()},
                                         {"rays", rays_}};
        stream.dispatch(isUpdate() ? aimNearKept_ : aimNear_, isUpdate() ? kept_->pairBindings(aimed) : aimed,
                        PairPush{first, count}, linearGroups(count));
        context.tracer.occluded(stream, rays_, occluded_, count);
        std::vector<Binding> hidden{{"occluded", occluded_}, {"NeighboursAt", patches.neighbours.at()}};
        if (isUpdate())
            hidden = kept_->hiddenBindings(patches, {{"WhoseAt", whose.at()}, hidden[0], hidden[1]});
        stream.dispatch(isUpdate() ? partNearKept_ : partNear_, hidden, PairPush{first, count},
                        linearGroups(count));
    });
    stream.finish();
}

void FindPatches::findParts(PassContext& context) {
    const VoxelClusters& clusters = context.get(clusters_);
    VoxelPatches& patches = context.get(patches_);
    CommandStream& stream = context.stream;
    Device& device = context.device;
    const uint32_t sides = patches.sideCount, words = (sides + 31) / 32;
    const Buffer labels(device, "labels of sides", uints(sides));
    stream.dispatch(label_, {{"labels", labels}}, sides, linearGroups(sides));
    for (bool isDone = false; !isDone;) {
        stream.fill(counter_, 0);
        stream.dispatch(spread_,
                        {{"sides", patches.sides},
                         {"firstNeighbour", patches.firstNeighbour},
                         {"NeighboursAt", patches.neighbours.at()},
                         {"ofVoxel", clusters.ofVoxel},
                         {"labels", labels},
                         {"changed", counter_}},
                        sides, linearGroups(sides));
        isDone = stream.readAs<uint32_t>(counter_, 1)[0] == 0;
    }
    const Buffer flags(device, "sides that lead parts", uints(words));
    const Buffer leaders(device, "leaders of parts", uints(sides)), numbers(device, "parts", uints(sides));
    stream.dispatch(
        flag_,
        {{"sides", patches.sides}, {"ofVoxel", clusters.ofVoxel}, {"labels", labels}, {"flags", flags}},
        sides, linearGroups(words));
    patches.partCount = compaction_->run(stream, flags, leaders, words);
    stream.fill(numbers, NO_PART);
    stream.dispatch(number_, {{"leaders", leaders}, {"numbers", numbers}}, patches.partCount,
                    linearGroups(patches.partCount));

    // Sides by part: the sort is stable, so those of a part stay in their order
    Buffer keys(device, "parts of sides", uints(sides));
    patches.ofSide = Buffer(device, "parts of sides", uints(sides));
    patches.members = Buffer(device, "sides by part", uints(sides));
    patches.parts =
        Buffer(device, "parts of clusters", std::max(patches.partCount, 1u) * sizeof(gpu::ClusterPart));
    stream.dispatch(assign_,
                    {{"labels", labels},
                     {"numbers", numbers},
                     {"ofSide", patches.ofSide},
                     {"keys", keys},
                     {"members", patches.members}},
                    AssignPush{sides, patches.partCount}, linearGroups(sides));
    radixSort_->record(stream, keys, patches.members, sides, uint32_t(std::bit_width(patches.partCount)));
    const Buffer counts(device, "sides of parts", uints(patches.partCount));
    const Buffer before(device, "sides before parts", uints(patches.partCount));
    histogram_->record(stream, patches.ofSide, counts, sides, patches.partCount);
    prefixSum_->run(stream, counts, before, patches.partCount);
    stream.dispatch(parts_, {{"counts", counts}, {"before", before}, {"parts", patches.parts}},
                    patches.partCount, linearGroups(patches.partCount));
    stream.finish();
}

}  // namespace voxray
