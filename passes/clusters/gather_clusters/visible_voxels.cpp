#include "passes/clusters/gather_clusters/visible_voxels.h"

#include "passes/common/compute/uint_bytes.h"

namespace voxray {

VisibleVoxels::VisibleVoxels(ProgramOwner& owner, GatherUpdate update)
    : markVoxels_(owner, "mark_visible_voxels.comp"),
      listGroups_(owner, "list_groups.comp"),
      dilate_(owner, "dilate.comp") {
    if (update == GatherUpdate::SeenPoints) points_.emplace(owner);
}

void VisibleVoxels::plan(PassPlan& plan) {
    markVoxels_.compileIf(!points_);
    if (points_) points_->plan(plan);
}

void VisibleVoxels::reset(PassContext& context, const SurfaceVoxels& voxels, const VoxelPatches& patches) {
    const auto make = [&](Buffer& buffer, const char* name, uint64_t count) {
        ensureSize(buffer, context.device, name, uintBytes(count));
    };
    make(requestedVoxels_, "requested voxels", voxels.voxelCount);
    make(newVoxels_, "new voxels", voxels.voxelCount);
    make(listedGroups_, "listed groups", patches.groupCount);
    make(isListed_, "flags of listed groups", patches.groupCount);
    make(count_, "count of new voxels", 1);
    context.stream.fill(requestedVoxels_, 0);
}

void VisibleVoxels::markLookups(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
                                uint32_t reach) const {
    const glm::uvec2 texels = gbufferExtent(context.frame, gbuffer.samples);
    context.dispatch(markVoxels_, texels,
                     {gbuffer,
                      voxels,
                      {"requestedVoxels", requestedVoxels_},
                      {"newVoxels", newVoxels_},
                      {"count", count_},
                      {"texels", texels},
                      {"reach", int32_t(reach)}});
}

VisibleVoxels::NewVoxels VisibleVoxels::find(PassContext& context, const GBuffer* gbuffer, const SurfaceVoxels& voxels,
                                             const VoxelClusters& clusters, const VoxelPatches& patches, uint32_t reach,
                                             uint32_t steps) const {
    CommandStream& stream = context.stream;
    NewVoxels found;
    const auto readCount = [&] { return stream.readAs<uint32_t>(count_, 1)[0]; };
    stream.fill(count_, 0);
    if (points_)
        points_->mark(context, voxels, clusters.coordinates, requestedVoxels_, newVoxels_, count_);
    else
        markLookups(context, *gbuffer, voxels, reach);
    found.voxelCount = readCount();
    if (found.voxelCount == 0) return found;

    stream.fill(count_, 0);
    stream.fill(isListed_, 0);
    context.dispatch(listGroups_, found.voxelCount,
                     {{"newVoxels", newVoxels_},
                      {"firstGroup", patches.firstGroup},
                      {"groups", patches.groups},
                      {"isListed", isListed_},
                      {"listedGroups", listedGroups_},
                      {"count", count_},
                      {"voxels", found.voxelCount}});
    found.groupCounts = {readCount()};
    uint32_t first = 0;
    for (uint32_t i = 0; i < steps; ++i) {
        const uint32_t end = found.groupCounts.back();
        context.dispatch(dilate_, end - first,
                         {voxels,
                          {"coordinates", clusters.coordinates},
                          {"groups", patches.groups},
                          {"firstGroup", patches.firstGroup},
                          {"firstNeighbor", patches.firstNeighbor},
                          {"NeighborsRef", patches.neighbors.ref()},
                          {"isListed", isListed_},
                          {"listedGroups", listedGroups_},
                          {"count", count_},
                          {"first", first},
                          {"groupCount", end - first}});
        found.groupCounts.push_back(readCount());
        first = end;
    }
    return found;
}

}  // namespace voxray
