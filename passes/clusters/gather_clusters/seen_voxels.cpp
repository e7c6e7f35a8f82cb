#include "passes/clusters/gather_clusters/seen_voxels.h"

#include "passes/common/compute/uints.h"

namespace voxray {

SeenVoxels::SeenVoxels(ProgramOwner& owner, GatherUpdate update)
    : mark_(owner, "mark.comp"), listSides_(owner, "list_sides.comp"), spread_(owner, "spread.comp") {
    if (update == GatherUpdate::SeenPoints) points_.emplace(owner);
}

void SeenVoxels::plan(PassPlan& plan) {
    mark_.compileIf(!points_);
    if (points_) points_->plan(plan);
}

void SeenVoxels::reset(PassContext& context, const SurfaceVoxels& voxels, const VoxelPatches& patches) {
    const auto make = [&](Buffer& buffer, const char* name, uint64_t count) {
        makeOrKeep(buffer, context.device, name, uints(count));
    };
    make(asked_, "voxels that were seen", voxels.voxelCount);
    make(found_, "voxels that come into view", voxels.voxelCount);
    make(listed_, "sides that come into view", patches.sideCount);
    make(reached_, "sides that were reached", patches.sideCount);
    make(count_, "how many come into view", 1);
    context.stream.fill(asked_, 0);
}

void SeenVoxels::mark(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
                      uint32_t reach) const {
    const glm::uvec2 texels = gbufferExtent(context.frame, gbuffer.samples);
    context.dispatch(mark_, texels,
                     {gbuffer,
                      voxels,
                      {"asked", asked_},
                      {"found", found_},
                      {"count", count_},
                      {"texels", texels},
                      {"reach", int32_t(reach)}});
}

SeenVoxels::Found SeenVoxels::find(PassContext& context, const GBuffer* gbuffer, const SurfaceVoxels& voxels,
                                   const VoxelClusters& clusters, const VoxelPatches& patches, uint32_t reach,
                                   uint32_t steps) const {
    CommandStream& stream = context.stream;
    Found found;
    const auto counted = [&] { return stream.readAs<uint32_t>(count_, 1)[0]; };
    stream.fill(count_, 0);
    if (points_)
        points_->mark(context, voxels, clusters.coordinates, asked_, found_, count_);
    else
        mark(context, *gbuffer, voxels, reach);
    found.voxelCount = counted();
    if (found.voxelCount == 0) return found;

    stream.fill(count_, 0);
    stream.fill(reached_, 0);
    context.dispatch(listSides_, found.voxelCount,
                     {{"found", found_},
                      {"firstSide", patches.firstSide},
                      {"sides", patches.sides},
                      {"reached", reached_},
                      {"listed", listed_},
                      {"count", count_},
                      {"voxels", found.voxelCount}});
    found.sidesWithin = {counted()};
    uint32_t first = 0;
    for (uint32_t i = 0; i < steps; ++i) {
        const uint32_t end = found.sidesWithin.back();
        context.dispatch(spread_, end - first,
                         {{"firstNeighbour", patches.firstNeighbour},
                          {"NeighboursAt", patches.neighbours.at()},
                          {"reached", reached_},
                          {"listed", listed_},
                          {"count", count_},
                          {"first", first},
                          {"sideCount", end - first}});
        found.sidesWithin.push_back(counted());
        first = end;
    }
    return found;
}

}  // namespace voxray
