#include "passes/clusters/find_patches/surfel_grouping.h"

#include "passes/common/compute/uint_bytes.h"
#include "trace/ray.h"

namespace voxray {
namespace {

/// Limit of unoccluded and of occluded groups in a voxel, as in neighbors.glsl. All remaining surfels join the last
/// one.
constexpr uint32_t kMaxGroupsPerVoxel = 8;

}  // namespace

void RayBatch::plan(MemoryPlan& plan, bool needsHits) {
    plan.scratchBuffer(rays, "rays between surfels", uint64_t(kRays) * sizeof(Ray));
    plan.scratchBuffer(occluded, "visibility of surfels", uint64_t(kRays) * sizeof(uint32_t));
    if (needsHits) plan.scratchBuffer(hits, "gaps before surfels", uint64_t(kRays) * sizeof(Hit));
}

SurfelGrouping::SurfelGrouping(ProgramOwner& owner)
    : generateGapRays_(owner, "generate_gap_rays.comp"),
      measureGapHeight_(owner, "measure_gap_height.comp"),
      selectSeed_(owner, "select_seed.comp"),
      generateVisibilityRays_(owner, "generate_visibility_rays.comp"),
      joinGroup_(owner, "join_group.comp") {}

void SurfelGrouping::run(PassContext& context, const RayBatch& batch, const SurfaceVoxels& voxels, bool hasOccluded,
                         const SurfelsByVoxel& surfelsByVoxel, const LargeBuffer& surfels) const {
    groupByVisibility(context, batch, voxels.voxelCount, surfelsByVoxel, surfels, false);
    if (!hasOccluded) return;
    measureGaps(context, batch, voxels.grid.voxelSize, surfelsByVoxel.sortedCount, surfels);
    groupByVisibility(context, batch, voxels.voxelCount, surfelsByVoxel, surfels, true);
}

void SurfelGrouping::measureGaps(PassContext& context, const RayBatch& batch, float voxelSize, uint32_t surfelCount,
                                 const LargeBuffer& surfels) const {
    RayBatch::inBatches(surfelCount, [&](uint32_t first, uint32_t count) {
        context.dispatch(generateGapRays_, count,
                         {{"rays", batch.rays},
                          {"GroupedSurfelsRef", surfels.ref()},
                          {"first", first},
                          {"count", count},
                          {"voxelSize", voxelSize}});
        context.tracer.closestHit(context.stream, batch.rays, batch.hits, count);
        context.dispatch(
            measureGapHeight_, count,
            {{"hits", batch.hits}, {"GroupedSurfelsRef", surfels.ref()}, {"first", first}, {"count", count}});
    });
}

void SurfelGrouping::groupByVisibility(PassContext& context, const RayBatch& batch, uint32_t voxels,
                                       const SurfelsByVoxel& surfelsByVoxel, const LargeBuffer& surfels,
                                       bool occluded) const {
    CommandStream& stream = context.stream;
    const Buffer seeds(context.device, "seeds of surface groups", uintBytes(voxels));
    const Buffer remaining(context.device, "voxels with surfels without a group", uintBytes(1));
    for (uint32_t i = 0; i < kMaxGroupsPerVoxel; ++i) {
        const uint32_t round = (occluded ? kMaxGroupsPerVoxel : 0) + i;
        stream.fill(remaining, 0);
        context.dispatch(selectSeed_, voxels,
                         {{"surfelRanges", surfelsByVoxel.ranges},
                          {"seeds", seeds},
                          {"remaining", remaining},
                          {"GroupedSurfelsRef", surfels.ref()},
                          {"voxels", voxels},
                          {"round", round},
                          {"groupsOccluded", occluded}});
        if (stream.readAs<uint32_t>(remaining, 1)[0] == 0) break;
        RayBatch::inBatches(surfelsByVoxel.sortedCount, [&](uint32_t first, uint32_t count) {
            context.dispatch(generateVisibilityRays_, count,
                             {{"seeds", seeds},
                              {"rays", batch.rays},
                              {"GroupedSurfelsRef", surfels.ref()},
                              {"first", first},
                              {"count", count},
                              {"groupsOccluded", occluded}});
            context.tracer.occluded(stream, batch.rays, batch.occluded, count);
            context.dispatch(joinGroup_, count,
                             {{"occluded", batch.occluded},
                              {"GroupedSurfelsRef", surfels.ref()},
                              {"first", first},
                              {"count", count},
                              {"round", round},
                              {"isLast", i + 1 == kMaxGroupsPerVoxel},
                              {"groupsOccluded", occluded}});
        });
    }
    stream.finish();
}

}  // namespace voxray
