#include "passes/find_patches/find_patches.h"

#include <algorithm>

#include "base/error.h"
#include "passes/common/compute/bindings.h"
#include "passes/common/compute/dispatch.h"
#include "passes/common/compute/uints.h"

namespace voxray {
namespace {

/// Of a side, in the mean: two layers of the voxels round it.
constexpr uint64_t kNeighbours = 18;

struct ChunkPush {
    gpu::VoxelGrid grid;
    uint32_t count;
    uint32_t firstNumber;
};

struct NearPush {
    gpu::VoxelGrid grid;
    uint32_t sides;
};

struct PairPush {
    uint32_t first;
    uint32_t count;
};

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
    plan.reserve("surfels by side (estimated)", surfels * sizeof(gpu::PatchSurfel) + uints(surfels));
    plan.reserve(
        "sides of voxels (estimated)",
        sides * (sizeof(gpu::SurfaceSide) + sizeof(gpu::PackedVoxelMaterial)) + uints(voxels + sides));
    plan.reserve("neighbours of sides (estimated)", uints(sides) + uints(pairs));
    PartSearch::plan(plan, sides);

    // One after another: surfels are sorted by voxel, and the lists stay until sides are found, which takes a
    // uint a voxel or a side (less than the sort did); then come whose neighbours they are, then parts
    plan.reserveScratch(
        "search of sides and parts (estimated)",
        std::max({SurfelSort::listBytes(surfels, voxels) + SurfelSort::scratchBytes(voxels),
                  uints(pairs) + PrefixSum::scratchBytes(uint32_t(sides)), PartSearch::scratchBytes(sides)}));
    batch_.plan(plan, plan.get(surfels_).coveredSides);
    if (!movingRuns(plan.frame.scene->geometry).empty())
        KeptSides::plan(plan, plan.get(voxels_), surfels, sides, pairs);
}

void FindPatches::prepare(PassSetup& setup) {
    version_.reset();
    kept_.reset();
    sort_.prepare(setup);
    prefixSum_.emplace(setup.device, setup.compiler, PrefixSum::Of::Values);
    sideSearch_.emplace(setup.device, setup.compiler);
    partSearch_.emplace(setup.device, setup.compiler);
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
    order_ = program("order");
    list_ = program("list");
    describe_ = program("describe");
    numberPatches_ = program("number_patches");
    countNear_ = program("near");
    listNear_ = program("near", {{"LIST", "1"}});
    aimNear_ = program("aim_near");
    partNear_ = program("part_near");
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
    partSearch_->find(context.stream, context.get(clusters_), patches);
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
    sideSearch_->find(context, batch_, voxels, context.get(surfels_).coveredSides, lists, patches);
    if (kept_) kept_->rememberSurfels(stream, patches, context.get(surfels_).maxCount);
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
        return voxels.bindings(joined({{"coordinates", context.get(clusters_).coordinates},
                                       {"sides", patches.sides},
                                       {"firstSide", patches.firstSide},
                                       {"SideMaterialsAt", patches.materials.at()}},
                                      more));
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
    RayBatch::inBatches(pairs, [&](uint32_t first, uint32_t count) {
        const std::vector<Binding> aimed{{"sides", patches.sides},
                                         {"NeighboursAt", patches.neighbours.at()},
                                         {"WhoseAt", whose.at()},
                                         {"rays", batch_.rays}};
        stream.dispatch(isUpdate() ? aimNearKept_ : aimNear_, isUpdate() ? kept_->pairBindings(aimed) : aimed,
                        PairPush{first, count}, linearGroups(count));
        context.tracer.occluded(stream, batch_.rays, batch_.occluded, count);
        std::vector<Binding> hidden{{"occluded", batch_.occluded}, {"NeighboursAt", patches.neighbours.at()}};
        if (isUpdate())
            hidden = kept_->hiddenBindings(patches, {{"WhoseAt", whose.at()}, hidden[0], hidden[1]});
        stream.dispatch(isUpdate() ? partNearKept_ : partNear_, hidden, PairPush{first, count},
                        linearGroups(count));
    });
    stream.finish();
}

}  // namespace voxray
