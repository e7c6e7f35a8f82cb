#pragma once

#include <algorithm>
#include <cstdint>

#include "graph/pass.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Rays that are traced at once, and their results.
struct RayBatch {
    static constexpr uint32_t kRays = 1u << 20;
    Buffer rays, occluded;
    Buffer hits;  ///< If planned.

    /// Plans them as scratch.
    void plan(MemoryPlan& plan, bool needsHits);

    /// Calls f(first, count) for each batch of `count` rays.
    template <class F>
    static void inBatches(uint32_t count, F f) {
        for (uint32_t first = 0; first < count; first += kRays) f(first, std::min(kRays, count - first));
    }
};

/// Groups the surfels of each voxel that see each other. In each round the first surfel without a group
/// becomes the seed of a new one, and those that see the seed join it. Rays connect
/// points above the surfels: by half a voxel, or by half the gap before an occluded one.
class SurfelGrouping {
 public:
    explicit SurfelGrouping(ProgramOwner& owner);

    /// Groups surfels of `patches` without a group: first unoccluded ones, then occluded ones.
    /// @param hasOccluded whether there are any. @param lists each voxel's surfels in `patches`.
    void run(PassContext& context, const RayBatch& batch, const SurfaceVoxels& voxels, bool hasOccluded,
             const SurfelsByVoxel& lists, const VoxelPatches& patches) const;

 private:
    void measureGaps(PassContext& context, const RayBatch& batch, float voxelSize,
                     const VoxelPatches& patches) const;
    /// Groups unoccluded surfels, or occluded ones.
    void groupByVisibility(PassContext& context, const RayBatch& batch, uint32_t voxels,
                           const SurfelsByVoxel& lists, const VoxelPatches& patches, bool occluded) const;

    Kernel generateGapRays_, measureGapHeight_, selectSeed_, generateVisibilityRays_, joinGroup_;
};

}  // namespace voxray
