#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/clusters/find_patches/component_labeling.h"
#include "passes/clusters/find_patches/group_update_cache.h"
#include "passes/clusters/find_patches/surfel_grouping.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/uint_bytes.h"
#include "passes/surfels/surfel_sort.h"

namespace voxray {

/// Splits the surfels of each voxel into surface groups: surfels that see each other. Splits clusters into connected
/// components of these groups, so that light does not leak through walls thinner than a voxel. A patch is the
/// projection of a surface group onto one of its voxel's six faces. An extension of Cosin and Patow 2022, who
/// have one surface in each voxel: docs/clusters.md, "How it works".
class FindPatches final : public Pass {
 public:
    static constexpr const char* kName = "find_patches";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Splits voxels' surfels and clusters at walls thinner than a voxel. "
        "Surfels of a voxel that see each other form a surface group; "
        "clusters are split into connected components of these groups. "
        "So the two surfaces of a wall thinner than a voxel have separate light (cluster_visibility, inject_clusters, "
        "gather_clusters). If place_surfels has 'sides: all', surfaces inside narrow gaps also form groups, "
        "and exchange light. Biased by: voxel size (rays start half a voxel above the surface, "
        "so they miss lower occluders and leave those surfels in one group). "
        "Noisy by: points_per_voxel (a surface without a surfel gets no group). Source: docs/clusters.md.";

    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Finds the group of each surfel within its voxel.
    void groupSurfels(PassContext& context, SurfelsByVoxel& surfelsByVoxel);
    /// Numbers the groups of all voxels and their patches.
    void listGroups(PassContext& context, const SurfelsByVoxel& surfelsByVoxel);
    /// Lists the groups in adjacent voxels that each group sees.
    void findNeighbors(PassContext& context);

    bool isUpdate() const { return updateCache_ && updateCache_->isActive(); }

    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<Surfels> surfels_{*this, "surfels", "points of their surfaces"};
    In<VoxelClusters> clusters_{*this, "clusters", "clusters of surface voxels"};
    Out<VoxelPatches> patches_{*this, "patches", "surface groups and patches of voxels"};
    SurfelSort sort_{*this};
    PrefixSum prefixSum_{*this, PrefixSum::Input::Uints};
    SurfelGrouping grouping_{*this};
    ComponentLabeling labeling_{*this};
    std::optional<GroupUpdateCache> updateCache_;  ///< For scenes with moving surfaces.
    // The same shaders for updates, in which results of the previous build are reused
    Kernel updateSurfels_{*this, "init_surfels.comp", {{"UPDATE", "1"}}};
    Kernel updateNeighborRays_{*this, "generate_neighbor_rays.comp", {{"UPDATE", "1"}}};
    Kernel updateNeighbors_{*this, "remove_occluded_neighbors.comp", {{"UPDATE", "1"}}};
    Kernel initSurfels_{*this, "init_surfels.comp"};
    Kernel sortSurfels_{*this, "sort_surfels.comp"};
    Kernel listGroups_{*this, "list_groups.comp"};
    Kernel averageMaterials_{*this, "average_materials.comp"};
    Kernel numberPatches_{*this, "number_patches.comp"};
    Kernel countNeighbors_{*this, "build_adjacency.comp"};
    Kernel listNeighbors_{*this, "build_adjacency.comp", {{"LIST", "1"}}};
    Kernel generateNeighborRays_{*this, "generate_neighbor_rays.comp"};
    Kernel removeOccludedNeighbors_{*this, "remove_occluded_neighbors.comp"};
    RayBatch batch_;  ///< Scratch.
};

void FindPatches::plan(PassPlan& plan) {
    batch_.plan(plan, plan[surfels_].hasOccludedSurfels);
    const bool surfacesMove = !movingInstanceRanges(plan.frame.scene->geometry).empty();
    for (Kernel* kernel : {&updateSurfels_, &updateNeighborRays_, &updateNeighbors_}) kernel->compileIf(surfacesMove);
    if (surfacesMove) updateCache_.emplace(*this);
}

void FindPatches::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& voxels = context[voxels_];
    const std::optional<std::vector<Box>>& changed = context.frame.changed;
    if (!voxels.unoccludedAreaOnly)
        throw Error("{}: needs the unoccluded area of voxels: set voxelize's 'visibility_rays' to 1 or more", kName);
    VoxelPatches& patches = context[patches_];
    if (updateCache_ && changed && !context.isFirstRun())
        updateCache_->startUpdate(context.stream, voxels, patches, *changed);
    patches.clear();
    SurfelsByVoxel surfelsByVoxel;
    sort_.run(context.stream, context[surfels_], voxels.voxelCount, surfelsByVoxel);
    groupSurfels(context, surfelsByVoxel);
    listGroups(context, surfelsByVoxel);
    surfelsByVoxel = {};
    findNeighbors(context);
    labeling_.run(context.stream, context[clusters_], patches);
    if (updateCache_) {
        updateCache_->finishUpdate();
        updateCache_->storeVoxels(context.stream, voxels);
    }
    context.report("surface groups", patches.groupCount);
    context.report("surface groups of a voxel", double(patches.groupCount) / voxels.voxelCount);
    context.report("patches for each voxel", double(patches.patchCount) / voxels.voxelCount);
    context.report("cluster components", patches.componentCount);
    context.report("bytes of surface groups", double(patches.bytes()));
}

void FindPatches::groupSurfels(PassContext& context, SurfelsByVoxel& surfelsByVoxel) {
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    patches.surfelCount = surfelsByVoxel.sortedCount;
    patches.surfels = LargeBuffer(context.device, "surfels by group",
                                  std::max(surfelsByVoxel.sortedCount, 1u) * sizeof(gpu::GroupedSurfel));
    std::vector<Binding> storedGroups;
    if (isUpdate()) storedGroups = updateCache_->surfelBindings(context[clusters_]);
    uint32_t firstIndex = 0;
    for (const Surfels::Chunk& chunk : context[surfels_].chunks) {
        context.dispatch(isUpdate() ? updateSurfels_ : initSurfels_, chunk.count,
                         {storedGroups,
                          {"surfels", chunk.surfels},
                          {"SortedIndicesRef", surfelsByVoxel.sortedIndices.ref()},
                          {"GroupedSurfelsRef", patches.surfels.ref()},
                          {"grid", voxels.grid},
                          {"count", chunk.count},
                          {"firstIndex", firstIndex}});
        firstIndex += chunk.count;
    }
    stream.finish();
    patches.surfelIndex = std::move(surfelsByVoxel.sortedIndices);
    surfelsByVoxel.sorted = {};
    grouping_.run(context, batch_, voxels, context[surfels_].hasOccludedSurfels, surfelsByVoxel, patches);
    // Each sample point has up to two surfels: one on each side
    if (updateCache_) updateCache_->storeSurfels(stream, patches, 2 * context[surfels_].pointCount);
}

void FindPatches::listGroups(PassContext& context, const SurfelsByVoxel& surfelsByVoxel) {
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t count = voxels.voxelCount;
    patches.firstGroup = Buffer(context.device, "first groups of voxels", uintBytes(count + 1));
    context.dispatch(sortSurfels_, count + 1,
                     {{"surfelRanges", surfelsByVoxel.ranges},
                      {"counts", patches.firstGroup},
                      {"GroupedSurfelsRef", patches.surfels.ref()},
                      {"voxels", count}});
    patches.groupCount = prefixSum_.run(stream, patches.firstGroup, patches.firstGroup, count + 1);
    const uint64_t groups = std::max(patches.groupCount, 1u);
    patches.groups = Buffer(context.device, "surface groups", groups * sizeof(gpu::SurfaceGroup));
    patches.materials =
        LargeBuffer(context.device, "materials of surface groups", groups * sizeof(gpu::PackedVoxelMaterial));
    context.dispatch(listGroups_, count,
                     {{"surfelRanges", surfelsByVoxel.ranges},
                      {"firstGroup", patches.firstGroup},
                      {"SurfelIndexRef", patches.surfelIndex.ref()},
                      {"groups", patches.groups},
                      {"GroupedSurfelsRef", patches.surfels.ref()},
                      {"voxels", count}});
    const Buffer patchCounts(context.device, "patch counts of surface groups", uintBytes(groups));
    context.dispatch(averageMaterials_, count,
                     {voxels,
                      {"groups", patches.groups},
                      {"firstGroup", patches.firstGroup},
                      {"GroupMaterialsRef", patches.materials.ref()},
                      {"patchCounts", patchCounts},
                      {"GroupedSurfelsRef", patches.surfels.ref()},
                      {"voxels", count}});
    patches.patchCount = prefixSum_.run(stream, patchCounts, patchCounts, patches.groupCount);
    context.dispatch(numberPatches_, patches.groupCount,
                     {{"firstPatches", patchCounts}, {"groups", patches.groups}, {"groupCount", patches.groupCount}});
    if (isUpdate()) updateCache_->findPreviousGroupIndices(stream, voxels, context[clusters_], patches);
    stream.finish();
}

void FindPatches::findNeighbors(PassContext& context) {
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t groups = patches.groupCount;
    const Bindings adjacency{voxels,
                             {"coordinates", context[clusters_].coordinates},
                             {"groups", patches.groups},
                             {"firstGroup", patches.firstGroup},
                             {"GroupMaterialsRef", patches.materials.ref()},
                             {"groupCount", groups}};
    patches.firstNeighbor = Buffer(context.device, "first neighbors of surface groups", uintBytes(groups + 1));
    context.dispatch(countNeighbors_, groups + 1, {adjacency.all(), {"counts", patches.firstNeighbor}});
    const uint32_t neighbors = prefixSum_.run(stream, patches.firstNeighbor, patches.firstNeighbor, groups + 1);
    patches.neighbors = LargeBuffer(context.device, "neighbors of surface groups", uintBytes(neighbors));
    const LargeBuffer groupOfEntry(context.device, "group of each neighbor entry", uintBytes(neighbors));
    context.dispatch(listNeighbors_, groups + 1,
                     {adjacency.all(),
                      {"firstNeighbor", patches.firstNeighbor},
                      {"NeighborsRef", patches.neighbors.ref()},
                      {"GroupOfEntryRef", groupOfEntry.ref()}});
    std::vector<Binding> reusedVisibility, previousNeighbors;
    if (isUpdate()) {
        reusedVisibility = updateCache_->neighborRayBindings();
        previousNeighbors = updateCache_->previousNeighborBindings(patches);
    }
    RayBatch::inBatches(neighbors, [&](uint32_t first, uint32_t count) {
        context.dispatch(isUpdate() ? updateNeighborRays_ : generateNeighborRays_, count,
                         {reusedVisibility,
                          {"groups", patches.groups},
                          {"NeighborsRef", patches.neighbors.ref()},
                          {"GroupOfEntryRef", groupOfEntry.ref()},
                          {"rays", batch_.rays},
                          {"first", first},
                          {"count", count}});
        context.tracer.occluded(stream, batch_.rays, batch_.occluded, count);
        context.dispatch(isUpdate() ? updateNeighbors_ : removeOccludedNeighbors_, count,
                         {previousNeighbors,
                          {"occluded", batch_.occluded},
                          {"NeighborsRef", patches.neighbors.ref()},
                          ifUsed({"GroupOfEntryRef", groupOfEntry.ref()}),
                          {"first", first},
                          {"count", count}});
    });
    stream.finish();
}

VOXRAY_REGISTER_PASS(FindPatches);

}  // namespace voxray
