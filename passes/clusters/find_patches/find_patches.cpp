#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/error.h"
#include "graph/registry.h"
#include "passes/clusters/find_patches/component_labeling.h"
#include "passes/clusters/find_patches/group_update_cache.h"
#include "passes/clusters/find_patches/grouped_surfel.h"
#include "passes/clusters/find_patches/surfel_grouping.h"
#include "passes/clusters/voxel_clusters.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/common/compute/uint_bytes.h"
#include "passes/surfels/surfel_points.h"
#include "passes/surfels/surfel_sort.h"

namespace voxray {
namespace {

constexpr uint32_t kChunkPoints = Surfels::kMaxChunkSurfels / 2;

}  // namespace

/// Splits the surfels of each voxel into surface groups: a group is a seed surfel and the surfels that it sees along a
/// line between points half a voxel above both. Splits clusters into connected components of these groups, so that
/// light does not leak through walls thinner than a voxel. A patch is the area of a surface group at one of its voxel's
/// six faces. An extension of Cosin and Patow 2022, who have one surface in each voxel: docs/clusters.md, "How it
/// works".
class FindPatches final : public Pass {
 public:
    static constexpr const char* kName = "find_patches";
    static constexpr bool kDependsOnLight = false;
    static constexpr const char* kHelp =
        "Splits voxels' surfels and clusters at walls thinner than a voxel. "
        "A surface group is a seed surfel and the surfels of its voxel that it sees, along a line between points half "
        "a voxel above both; "
        "clusters are split into connected components of these groups. "
        "So the two surfaces of a wall thinner than a voxel have separate light (cluster_visibility, inject_clusters, "
        "gather_clusters). If place_surfels has 'sides: all', surfaces inside narrow gaps also form groups, "
        "and exchange light. Biased by: voxel size (these lines pass over walls that rise less than half a "
        "voxel; the surfels on both sides of such a wall share a group). "
        "Noisy by: points_per_voxel (a surface without a surfel gets no group). Source: docs/clusters.md.";

    void plan(PassPlan& plan) override;
    void record(PassContext& context) override;

 private:
    /// Evaluates the surfels of kChunkPoints points or fewer, two of each: the voxel of one that does not exist is
    /// NO_VOXEL.
    Surfels::Chunk evaluateSurfels(PassContext& context, uint32_t firstPoint) const;
    /// Sorts the surfels by voxel and finds the group of each within its voxel.
    void groupSurfels(PassContext& context, SurfelsByVoxel& surfelsByVoxel);
    /// Numbers the groups of all voxels and their patches, and stores the surfels.
    void listGroups(PassContext& context, const SurfelsByVoxel& surfelsByVoxel);
    /// Lists the groups in adjacent voxels that each group sees.
    NeighborCandidates findNeighbors(PassContext& context);
    /// Stores these lists.
    void packNeighbors(PassContext& context, const NeighborCandidates& candidates);

    bool isUpdate() const { return updateCache_ && updateCache_->isActive(); }

    In<SurfaceVoxels> voxels_{*this, "voxels", "surface voxels"};
    In<SurfelPoints> points_{*this, "surfel_points", "points of their surfaces"};
    In<VoxelClusters> clusters_{*this, "clusters", "clusters of surface voxels"};
    Out<VoxelPatches> patches_{*this, "patches", "surface groups and patches of voxels"};
    SurfelSort sortByVoxel_{*this};
    PrefixSum prefixSum_{*this, PrefixSum::Input::Uints};
    SurfelGrouping grouping_{*this};
    ComponentLabeling labeling_{*this};
    std::optional<GroupUpdateCache> updateCache_;  ///< For scenes with moving surfaces.
    // Variants of shaders below (UPDATE), which reuse results of the previous build
    Kernel updateSurfels_{*this, "init_surfels.comp", {{"UPDATE", "1"}}};
    Kernel updateNeighborRays_{*this, "generate_neighbor_rays.comp", {{"UPDATE", "1"}}};
    Kernel updateNeighbors_{*this, "remove_occluded_neighbors.comp", {{"UPDATE", "1"}}};
    Kernel evaluateSurfels_{*this, "evaluate_surfels.comp"};
    Kernel initSurfels_{*this, "init_surfels.comp"};
    Kernel sortByGroupAndCount_{*this, "sort_surfels.comp"};
    Kernel listGroups_{*this, "list_groups.comp"};
    Kernel averageMaterials_{*this, "average_materials.comp"};
    Kernel numberPatches_{*this, "number_patches.comp"};
    Kernel countCandidates_{*this, "build_adjacency.comp"};
    Kernel listCandidates_{*this, "build_adjacency.comp", {{"LIST", "1"}}};
    Kernel generateNeighborRays_{*this, "generate_neighbor_rays.comp"};
    Kernel removeOccludedNeighbors_{*this, "remove_occluded_neighbors.comp"};
    Kernel storeIds_{*this, "store_ids.comp"};
    Kernel countKeptNeighbors_{*this, "pack_neighbors.comp"};
    Kernel packNeighbors_{*this, "pack_neighbors.comp", {{"LIST", "1"}}};
    RayBatch batch_;       ///< Scratch.
    LargeBuffer surfels_;  ///< gpu::GroupedSurfel each, sorted by voxel, group and id, while the pass records.
};

void FindPatches::plan(PassPlan& plan) {
    batch_.plan(plan, plan[points_].hasOccludedSurfels);
    const bool surfacesMove = !movingInstanceRanges(plan.frame.scene->geometry).empty();
    for (Kernel* kernel : {&updateSurfels_, &updateNeighborRays_, &updateNeighbors_}) kernel->compileIf(surfacesMove);
    if (surfacesMove) updateCache_.emplace(*this);
}

void FindPatches::record(PassContext& context) {
    if (!context.inputsChanged()) return;
    const SurfaceVoxels& voxels = context[voxels_];
    const std::optional<std::vector<Box>>& changed = context.frame.changedRegions;
    if (!voxels.areasAreUnoccluded)
        throw Error("{}: needs the unoccluded area of voxels: set voxelize's 'visibility_rays' to 1 or more", kName);
    VoxelPatches& patches = context[patches_];
    if (updateCache_ && changed && !context.isFirstRun())
        updateCache_->startUpdate(context.stream, voxels, patches, *changed);
    patches.clear();
    SurfelsByVoxel surfelsByVoxel;
    groupSurfels(context, surfelsByVoxel);
    listGroups(context, surfelsByVoxel);
    surfelsByVoxel = {};
    const NeighborCandidates candidates = findNeighbors(context);
    surfels_ = {};
    labeling_.run(context.stream, context[clusters_], candidates, patches);
    packNeighbors(context, candidates);
    if (updateCache_) {
        updateCache_->finishUpdate();
        updateCache_->storeVoxels(context.stream, voxels);
    }
    context.report("surface groups", patches.groupCount);
    context.report("surface groups of a voxel", double(patches.groupCount) / voxels.voxelCount);
    context.report("patches for each voxel", double(patches.patchCount) / voxels.voxelCount);
    context.report("cluster components", patches.componentCount);
    context.report("faces of cluster components", patches.componentFaceCount);
    context.report("bytes of surface groups", double(patches.bytes()));
}

Surfels::Chunk FindPatches::evaluateSurfels(PassContext& context, uint32_t firstPoint) const {
    const SurfelPoints& points = context[points_];
    const uint32_t batch = std::min(kChunkPoints, points.count - firstPoint);
    Surfels::Chunk chunk{Buffer(context.device, "surfels", 2 * batch * sizeof(gpu::Surfel)), 2 * batch, 2 * firstPoint};
    context.dispatch(evaluateSurfels_, batch,
                     {context.scene,
                      context[voxels_],
                      points,
                      {"SidesRef", points.sides.ref()},
                      {"surfels", chunk.surfels},
                      {"firstPoint", firstPoint},
                      {"points", batch}});
    return chunk;
}

void FindPatches::groupSurfels(PassContext& context, SurfelsByVoxel& surfelsByVoxel) {
    const SurfaceVoxels& voxels = context[voxels_];
    const SurfelPoints& points = context[points_];
    CommandStream& stream = context.stream;
    {
        Surfels surfels;
        for (uint32_t first = 0; first < points.count; first += kChunkPoints)
            surfels.chunks.push_back(evaluateSurfels(context, first));
        surfels.count = 2 * uint64_t(points.count);
        sortByVoxel_.run(stream, surfels, voxels.voxelCount, surfelsByVoxel);
        surfelsByVoxel.sorted = {};
    }
    const uint32_t count = context[patches_].surfelCount = surfelsByVoxel.sortedCount;
    surfels_ =
        LargeBuffer(context.device, "surfels by group", std::max<uint64_t>(count, 1) * sizeof(gpu::GroupedSurfel));
    std::vector<Binding> storedGroups;
    if (isUpdate()) storedGroups = updateCache_->surfelBindings(context[clusters_]);
    // Evaluated a second time, so that unsorted and sorted surfels are never in memory at once
    for (uint32_t first = 0; first < points.count; first += kChunkPoints) {
        const Surfels::Chunk chunk = evaluateSurfels(context, first);
        context.dispatch(isUpdate() ? updateSurfels_ : initSurfels_, chunk.count,
                         {storedGroups,
                          {"surfels", chunk.surfels},
                          {"SortedIndicesRef", surfelsByVoxel.sortedIndices.ref()},
                          {"GroupedSurfelsRef", surfels_.ref()},
                          {"grid", voxels.grid},
                          {"count", chunk.count},
                          {"firstIndex", chunk.firstIndex}});
        stream.finish();
    }
    surfelsByVoxel.sortedIndices = {};
    grouping_.run(context, batch_, voxels, points.hasOccludedSurfels, surfelsByVoxel, surfels_);
    // Each point has up to two surfels: one on each side
    if (updateCache_) updateCache_->storeSurfels(stream, surfels_, count, 2 * uint64_t(points.count));
}

void FindPatches::listGroups(PassContext& context, const SurfelsByVoxel& surfelsByVoxel) {
    const SurfaceVoxels& voxels = context[voxels_];
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t count = voxels.voxelCount;
    patches.firstGroup = Buffer(context.device, "first groups of voxels", uintBytes(count + 1));
    context.dispatch(sortByGroupAndCount_, count + 1,
                     {{"surfelRanges", surfelsByVoxel.ranges},
                      {"counts", patches.firstGroup},
                      {"GroupedSurfelsRef", surfels_.ref()},
                      {"voxelCount", count}});
    patches.surfelIds = LargeBuffer(context.device, "ids of surfels", uintBytes(patches.surfelCount));
    context.dispatch(storeIds_, patches.surfelCount,
                     {{"GroupedSurfelsRef", surfels_.ref()},
                      {"SurfelIdsRef", patches.surfelIds.ref()},
                      {"surfels", patches.surfelCount}});
    const uint32_t groups = patches.groupCount =
        prefixSum_.run(stream, patches.firstGroup, patches.firstGroup, count + 1);
    patches.groups = Buffer(context.device, "surface groups", (uint64_t(groups) + 1) * sizeof(gpu::SurfaceGroup));
    patches.materials = LargeBuffer(context.device, "materials of surface groups",
                                    std::max<uint64_t>(groups, 1) * sizeof(gpu::PackedGroupMaterial));
    context.dispatch(listGroups_, count + 1,
                     {{"surfelRanges", surfelsByVoxel.ranges},
                      {"firstGroup", patches.firstGroup},
                      {"groups", patches.groups},
                      {"GroupedSurfelsRef", surfels_.ref()},
                      {"voxelCount", count},
                      {"surfelCount", patches.surfelCount}});
    const Buffer patchCounts(context.device, "patch counts of surface groups", uintBytes(groups + 1));
    stream.fill(patchCounts, 0);
    context.dispatch(averageMaterials_, count,
                     {voxels,
                      {"groups", patches.groups},
                      {"firstGroup", patches.firstGroup},
                      {"GroupMaterialsRef", patches.materials.ref()},
                      {"patchCounts", patchCounts},
                      {"GroupedSurfelsRef", surfels_.ref()},
                      {"voxelCount", count}});
    patches.patchCount = prefixSum_.run(stream, patchCounts, patchCounts, groups + 1);
    context.dispatch(numberPatches_, groups + 1,
                     {{"firstPatches", patchCounts}, {"groups", patches.groups}, {"groupCount", groups}});
    if (isUpdate()) updateCache_->findPreviousGroupIndices(stream, voxels, context[clusters_], patches);
    stream.finish();
}

NeighborCandidates FindPatches::findNeighbors(PassContext& context) {
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
    NeighborCandidates candidates;
    candidates.first = Buffer(context.device, "first candidates for neighbors", uintBytes(groups + 1));
    context.dispatch(countCandidates_, groups + 1, {adjacency.all(), {"counts", candidates.first}});
    candidates.count = prefixSum_.run(stream, candidates.first, candidates.first, groups + 1);
    candidates.groups = LargeBuffer(context.device, "candidates for neighbors", uintBytes(candidates.count));
    const LargeBuffer groupOfCandidate(context.device, "group of each candidate", uintBytes(candidates.count));
    context.dispatch(listCandidates_, groups + 1,
                     {adjacency.all(),
                      {"firstCandidate", candidates.first},
                      {"CandidatesRef", candidates.groups.ref()},
                      {"GroupOfCandidateRef", groupOfCandidate.ref()}});
    std::vector<Binding> reusedVisibility, previousNeighbors;
    if (isUpdate()) {
        reusedVisibility = updateCache_->neighborRayBindings();
        previousNeighbors = updateCache_->previousNeighborBindings(context[clusters_], patches);
    }
    RayBatch::inBatches(candidates.count, [&](uint32_t first, uint32_t count) {
        context.dispatch(isUpdate() ? updateNeighborRays_ : generateNeighborRays_, count,
                         {reusedVisibility,
                          {"groups", patches.groups},
                          {"GroupedSurfelsRef", surfels_.ref()},
                          {"CandidatesRef", candidates.groups.ref()},
                          {"GroupOfCandidateRef", groupOfCandidate.ref()},
                          {"rays", batch_.rays},
                          {"first", first},
                          {"count", count}});
        context.tracer.occluded(stream, batch_.rays, batch_.occluded, count);
        context.dispatch(isUpdate() ? updateNeighbors_ : removeOccludedNeighbors_, count,
                         {previousNeighbors,
                          {"occluded", batch_.occluded},
                          {"CandidatesRef", candidates.groups.ref()},
                          ifUsed({"GroupOfCandidateRef", groupOfCandidate.ref()}),
                          {"first", first},
                          {"count", count}});
    });
    stream.finish();
    return candidates;
}

void FindPatches::packNeighbors(PassContext& context, const NeighborCandidates& candidates) {
    VoxelPatches& patches = context[patches_];
    CommandStream& stream = context.stream;
    const uint32_t groups = patches.groupCount;
    const Bindings kept{
        {"firstCandidate", candidates.first}, {"CandidatesRef", candidates.groups.ref()}, {"groupCount", groups}};
    patches.firstNeighbor = Buffer(context.device, "first neighbors of surface groups", uintBytes(groups + 1));
    context.dispatch(countKeptNeighbors_, groups + 1, {kept.all(), {"counts", patches.firstNeighbor}});
    const uint32_t neighbors = prefixSum_.run(stream, patches.firstNeighbor, patches.firstNeighbor, groups + 1);
    patches.neighbors = LargeBuffer(context.device, "neighbors of surface groups", uintBytes((neighbors + 3) / 4));
    stream.fill(patches.neighbors, 0);
    context.dispatch(packNeighbors_, groups + 1,
                     {kept.all(),
                      {"coordinates", context[clusters_].coordinates},
                      {"groups", patches.groups},
                      {"firstGroup", patches.firstGroup},
                      {"firstNeighbor", patches.firstNeighbor},
                      {"NeighborsRef", patches.neighbors.ref()}});
    stream.finish();
}

VOXRAY_REGISTER_PASS(FindPatches);

}  // namespace voxray
