#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/clusters/find_patches/kept_sides.h"
#include "passes/clusters/find_patches/part_search.h"
#include "passes/clusters/find_patches/side_search.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/uints.h"
#include "passes/surfels/surfel_sort.h"

namespace voxray {

/// Splits the surfaces of each voxel by the space that they look into, and clusters likewise, so that
/// no side of a thin wall holds the other side's light. Beyond Cosin and Patow 2022; docs/clusters.md.
class FindPatches final : public Pass {
 public:
    static constexpr const char* kName = "find_patches";
    static constexpr const char* kHelp =
        "Splits voxels' surfels and clusters at walls thinner than a voxel. The surfels of a voxel fall into "
        "sides, those between which nothing stands, and clusters into parts that hang together. So both "
        "sides of a wall that is thinner than a voxel are told apart where light is gathered "
        "(cluster_visibility, inject_clusters, gather_clusters). With place_surfels' 'sides: all' gaps "
        "narrower than a voxel have sides, too, which send light and receive it. Biased by: voxel size (what "
        "hides less than half a voxel above surfaces splits nothing). Noisy by: points_per_voxel (a surface "
        "without a point has no side). Source: docs/clusters.md.";

    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// The side of its voxel that each surfel is on.
    void findSides(PassContext& context, SurfelsByVoxel& lists);
    void listSides(PassContext& context, const SurfelsByVoxel& lists);
    /// Sides next to each other that nothing hides.
    void findNeighbours(PassContext& context);

    bool isUpdate() const { return kept_ && kept_->isActive(); }

    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<Surfels> surfels_{*this, "surfels", "points of their surfaces"};
    In<VoxelClusters> clusters_{*this, "clusters", "surface voxels in groups"};
    Out<VoxelPatches> patches_{*this, "patches", "surfaces by the open space that they look into"};
    SurfelSort sort_{*this};
    PrefixSum prefixSum_{*this, PrefixSum::Of::Values};
    SideSearch sideSearch_{*this};
    PartSearch partSearch_{*this};
    std::optional<KeptSides> kept_;  ///< Where surfaces move.
    Kernel beginKept_{*this, "begin.comp", {{"KEEP", "1"}}};
    Kernel aimNearKept_{*this, "aim_near.comp", {{"KEEP", "1"}}};
    Kernel partNearKept_{*this, "part_near.comp", {{"KEEP", "1"}}};
    Kernel begin_{*this, "begin.comp"};
    Kernel order_{*this, "order.comp"};
    Kernel list_{*this, "list.comp"};
    Kernel describe_{*this, "describe.comp"};
    Kernel numberPatches_{*this, "number_patches.comp"};
    Kernel countNear_{*this, "near.comp"};
    Kernel listNear_{*this, "near.comp", {{"LIST", "1"}}};
    Kernel aimNear_{*this, "aim_near.comp"};
    Kernel partNear_{*this, "part_near.comp"};
    RayBatch batch_;  ///< Scratch.
};

void FindPatches::plan(PassPlan& plan) {
    batch_.plan(plan, plan[surfels_].coveredSides);
    const bool surfacesMove = !movingRuns(plan.frame.scene->geometry).empty();
    for (Kernel* kernel : {&beginKept_, &aimNearKept_, &partNearKept_}) kernel->compileIf(surfacesMove);
    if (surfacesMove) kept_.emplace(*this);
}

void FindPatches::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& voxels = context[voxels_];
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (!voxels.unoccludedOnly)
        throw Error(
            "{}: surfels without open space before them have no side; leave voxelize's 'visibility_rays' "
            "above 0",
            kName);
    VoxelPatches& patches = context[patches_];
    if (kept_ && changed && !context.isFirstRun()) kept_->begin(context.stream, voxels, patches, *changed);
    patches.clear();
    SurfelsByVoxel lists;
    sort_.run(context.stream, context[surfels_], voxels.voxelCount, lists);
    findSides(context, lists);
    listSides(context, lists);
    lists = {};
    findNeighbours(context);
    partSearch_.find(context.stream, context[clusters_], patches);
    if (kept_) kept_->end();
    if (kept_) kept_->rememberVoxels(context.stream, voxels);
    context.report("sides of voxels", patches.sideCount);
    context.report("sides for each voxel", double(patches.sideCount) / voxels.voxelCount);
    context.report("patches for each voxel", double(patches.patchCount) / voxels.voxelCount);
    context.report("parts of clusters", patches.partCount);
    context.report("bytes of sides", double(patches.bytes()));
}

void FindPatches::findSides(PassContext& context, SurfelsByVoxel& lists) {
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    patches.surfelCount = lists.slotCount;
    patches.surfels = LargeBuffer(context.device, "surfels by side",
                                  std::max(lists.slotCount, 1u) * sizeof(gpu::PatchSurfel));
    std::vector<Binding> kept;
    if (isUpdate()) kept = kept_->surfelBindings(context[clusters_]);
    uint32_t number = 0;
    for (const Surfels::Chunk& chunk : context[surfels_].chunks) {
        context.dispatch(isUpdate() ? beginKept_ : begin_, chunk.count,
                         {kept,
                          {"surfels", chunk.surfels},
                          {"SlotsAt", lists.slots.at()},
                          {"PatchSurfelsAt", patches.surfels.at()},
                          {"grid", voxels.grid},
                          {"count", chunk.count},
                          {"firstNumber", number}});
        number += chunk.count;
    }
    stream.finish();
    patches.places = std::move(lists.slots);
    lists.sorted = {};
    sideSearch_.find(context, batch_, voxels, context[surfels_].coveredSides, lists, patches);
    if (kept_) kept_->rememberSurfels(stream, patches, 2 * context[surfels_].pointCount);
}

void FindPatches::listSides(PassContext& context, const SurfelsByVoxel& lists) {
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t count = voxels.voxelCount;
    patches.firstSide = Buffer(context.device, "first side by voxel", uints(count + 1));
    context.dispatch(order_, count + 1,
                     {{"lists", lists.lists},
                      {"counts", patches.firstSide},
                      {"PatchSurfelsAt", patches.surfels.at()},
                      {"voxels", count}});
    patches.sideCount = prefixSum_.run(stream, patches.firstSide, patches.firstSide, count + 1);
    const uint64_t sides = std::max(patches.sideCount, 1u);
    patches.sides = Buffer(context.device, "sides of voxels", sides * sizeof(gpu::SurfaceSide));
    patches.materials =
        LargeBuffer(context.device, "materials of sides", sides * sizeof(gpu::PackedVoxelMaterial));
    context.dispatch(list_, count,
                     {{"lists", lists.lists},
                      {"firstSide", patches.firstSide},
                      {"PlacesAt", patches.places.at()},
                      {"sides", patches.sides},
                      {"PatchSurfelsAt", patches.surfels.at()},
                      {"voxels", count}});
    const Buffer counts(context.device, "patches of sides", uints(sides));
    context.dispatch(describe_, count,
                     {voxels,
                      {"sides", patches.sides},
                      {"firstSide", patches.firstSide},
                      {"SideMaterialsAt", patches.materials.at()},
                      {"counts", counts},
                      {"PatchSurfelsAt", patches.surfels.at()},
                      {"voxels", count}});
    patches.patchCount = prefixSum_.run(stream, counts, counts, patches.sideCount);
    context.dispatch(numberPatches_, patches.sideCount,
                     {{"before", counts}, {"sides", patches.sides}, {"sideCount", patches.sideCount}});
    if (isUpdate()) kept_->findPrevious(stream, voxels, context[clusters_], patches);
    stream.finish();
}

void FindPatches::findNeighbours(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t sides = patches.sideCount;
    const Bindings near{voxels,
                        {"coordinates", context[clusters_].coordinates},
                        {"sides", patches.sides},
                        {"firstSide", patches.firstSide},
                        {"SideMaterialsAt", patches.materials.at()},
                        {"sideCount", sides}};
    patches.firstNeighbour = Buffer(context.device, "first neighbour of each side", uints(sides + 1));
    context.dispatch(countNear_, sides + 1, {near.all(), {"counts", patches.firstNeighbour}});
    const uint32_t pairs = prefixSum_.run(stream, patches.firstNeighbour, patches.firstNeighbour, sides + 1);
    patches.neighbours = LargeBuffer(context.device, "neighbours of sides", uints(pairs));
    const LargeBuffer whose(context.device, "whose neighbours", uints(pairs));
    context.dispatch(listNear_, sides + 1,
                     {near.all(),
                      {"firstNeighbour", patches.firstNeighbour},
                      {"NeighboursAt", patches.neighbours.at()},
                      {"WhoseAt", whose.at()}});
    std::vector<Binding> keptPairs, keptHidden;
    if (isUpdate()) {
        keptPairs = kept_->pairBindings();
        keptHidden = kept_->hiddenBindings(patches);
    }
    RayBatch::inBatches(pairs, [&](uint32_t first, uint32_t count) {
        context.dispatch(isUpdate() ? aimNearKept_ : aimNear_, count,
                         {keptPairs,
                          {"sides", patches.sides},
                          {"NeighboursAt", patches.neighbours.at()},
                          {"WhoseAt", whose.at()},
                          {"rays", batch_.rays},
                          {"first", first},
                          {"count", count}});
        context.tracer.occluded(stream, batch_.rays, batch_.occluded, count);
        context.dispatch(isUpdate() ? partNearKept_ : partNear_, count,
                         {keptHidden,
                          {"occluded", batch_.occluded},
                          {"NeighboursAt", patches.neighbours.at()},
                          ifUsed({"WhoseAt", whose.at()}),
                          {"first", first},
                          {"count", count}});
    });
    stream.finish();
}

VOXRAY_REGISTER_PASS(FindPatches);

}  // namespace voxray
