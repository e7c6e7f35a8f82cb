#include "passes/clusters/find_patches/side_search.h"

#include "passes/common/compute/uints.h"
#include "trace/ray.h"

namespace voxray {
namespace {

/// Of a voxel, open or covered: what is left is on the last one.
constexpr uint32_t kMaxPatchSides = 8;

}  // namespace

void RayBatch::plan(MemoryPlan& plan, bool meetSurfaces) {
    plan.scratchBuffer(rays, "rays between surfels", uint64_t(kRays) * sizeof(Ray));
    plan.scratchBuffer(occluded, "visibility of surfels", uint64_t(kRays) * sizeof(uint32_t));
    if (meetSurfaces) plan.scratchBuffer(hits, "gaps before surfels", uint64_t(kRays) * sizeof(Hit));
}

SideSearch::SideSearch(ProgramOwner& owner)
    : aimAcross_(owner, "aim_across.comp"),
      raise_(owner, "raise.comp"),
      pivot_(owner, "pivot.comp"),
      aim_(owner, "aim.comp"),
      join_(owner, "join.comp") {}

void SideSearch::find(PassContext& context, const RayBatch& batch, const SurfaceVoxels& voxels,
                      bool coveredSides, const SurfelsByVoxel& lists, const VoxelPatches& patches) const {
    splitByRays(context, batch, voxels.voxelCount, lists, patches, 0);
    if (!coveredSides) return;
    raiseCovered(context, batch, voxels.grid.voxelSize, patches);
    splitByRays(context, batch, voxels.voxelCount, lists, patches, 1);
}

void SideSearch::raiseCovered(PassContext& context, const RayBatch& batch, float voxelSize,
                              const VoxelPatches& patches) const {
    RayBatch::inBatches(patches.surfelCount, [&](uint32_t first, uint32_t count) {
        context.dispatch(aimAcross_, count,
                         {{"rays", batch.rays},
                          {"PatchSurfelsAt", patches.surfels.at()},
                          {"first", first},
                          {"count", count},
                          {"voxelSize", voxelSize}});
        context.tracer.closestHit(context.stream, batch.rays, batch.hits, count);
        context.dispatch(raise_, count,
                         {{"hits", batch.hits},
                          {"PatchSurfelsAt", patches.surfels.at()},
                          {"first", first},
                          {"count", count}});
    });
}

void SideSearch::splitByRays(PassContext& context, const RayBatch& batch, uint32_t voxels,
                             const SurfelsByVoxel& lists, const VoxelPatches& patches,
                             uint32_t isCovered) const {
    CommandStream& stream = context.stream;
    const Buffer pivots(context.device, "surfels that began sides", uints(voxels));
    const Buffer left(context.device, "voxels with surfels on no side", uints(1));
    for (uint32_t i = 0; i < kMaxPatchSides; ++i) {
        const uint32_t round = isCovered * kMaxPatchSides + i;
        stream.fill(left, 0);
        context.dispatch(pivot_, voxels,
                         {{"lists", lists.lists},
                          {"pivots", pivots},
                          {"left", left},
                          {"PatchSurfelsAt", patches.surfels.at()},
                          {"voxels", voxels},
                          {"round", round},
                          {"isCovered", isCovered}});
        if (stream.readAs<uint32_t>(left, 1)[0] == 0) break;
        RayBatch::inBatches(patches.surfelCount, [&](uint32_t first, uint32_t count) {
            context.dispatch(aim_, count,
                             {{"pivots", pivots},
                              {"rays", batch.rays},
                              {"PatchSurfelsAt", patches.surfels.at()},
                              {"first", first},
                              {"count", count},
                              {"isCovered", isCovered}});
            context.tracer.occluded(stream, batch.rays, batch.occluded, count);
            context.dispatch(join_, count,
                             {{"occluded", batch.occluded},
                              {"PatchSurfelsAt", patches.surfels.at()},
                              {"first", first},
                              {"count", count},
                              {"round", round},
                              {"isLast", i + 1 == kMaxPatchSides},
                              {"isCovered", isCovered}});
        });
    }
    stream.finish();
}

}  // namespace voxray
