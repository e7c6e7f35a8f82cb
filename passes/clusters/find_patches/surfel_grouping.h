#pragma once

#include <algorithm>
#include <cstdint>

#include "graph/pass.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Buffers for a batch of rays and its results.
struct RayBatch {
    static constexpr uint32_t kRays = 1u << 20;
    Buffer rays, occluded;
    Buffer hits;  ///< Only if plan() got `needsHits`.

    /// Plans the buffers as scratch.
    void plan(MemoryPlan& plan, bool needsHits);

    /// Calls f(first, count) for each batch of `count` rays.
    template <class F>
    static void inBatches(uint32_t count, F f) {
        for (uint32_t first = 0; first < count; first += kRays) f(first, std::min(kRays, count - first));
    }
};

/// Groups the surfels of each voxel that see each other. In each round the first surfel without a group
/// becomes the seed of a new group, and the surfels that see the seed join it. Visibility rays connect points
/// at a height above the surfels: half a voxel, or half the gap in front of occluded surfels.
class SurfelGrouping {
 public:
    explicit SurfelGrouping(ProgramOwner& owner);

    /// Groups the surfels that have no group yet: first unoccluded ones, then occluded ones.
    /// @param hasOccluded whether there are occluded surfels. @param surfelsByVoxel the surfels of each voxel.
    /// @param surfels gpu::GroupedSurfel each.
    void run(PassContext& context, const RayBatch& batch, const SurfaceVoxels& voxels, bool hasOccluded,
             const SurfelsByVoxel& surfelsByVoxel, const LargeBuffer& surfels) const;

 private:
    void measureGaps(PassContext& context, const RayBatch& batch, float voxelSize, uint32_t surfelCount,
                     const LargeBuffer& surfels) const;
    /// Groups only occluded or only unoccluded surfels.
    void groupByVisibility(PassContext& context, const RayBatch& batch, uint32_t voxels,
                           const SurfelsByVoxel& surfelsByVoxel, const LargeBuffer& surfels, bool occluded) const;

    Kernel generateGapRays_, measureGapHeight_, selectSeed_, generateVisibilityRays_, joinGroup_;
};

}  // namespace voxray
