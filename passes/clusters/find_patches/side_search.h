#pragma once

#include <algorithm>
#include <cstdint>

#include "graph/pass.h"
#include "passes/clusters/voxel_patches.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Rays that are traced at once, and what they meet.
struct RayBatch {
    static constexpr uint32_t kRays = 1u << 20;
    Buffer rays, occluded;
    Buffer hits;  ///< Where surfaces are asked for.

    /// Describes them as scratch.
    void plan(MemoryPlan& plan, bool meetSurfaces);

    /// Calls f with the first and the number of each batch of rays.
    template <class F>
    static void inBatches(uint32_t count, F f) {
        for (uint32_t first = 0; first < count; first += kRays) f(first, std::min(kRays, count - first));
    }
};

/// Splits the surfels of each voxel into sides, by rays from one to the others.
class SideSearch {
 public:
    explicit SideSearch(ProgramOwner& owner);

    /// Writes the side of its voxel that each surfel is on which is on none yet: first of open surfels, then
    /// of covered ones, whose height is half of the gap that they are in.
    /// @param lists the places of each voxel's surfels in `patches`.
    void find(PassContext& context, const RayBatch& batch, const SurfaceVoxels& voxels, bool coveredSides,
              const SurfelsByVoxel& lists, const VoxelPatches& patches) const;

 private:
    void raiseCovered(PassContext& context, const RayBatch& batch, float voxelSize,
                      const VoxelPatches& patches) const;
    /// The sides of open surfels, or those of covered ones.
    void splitByRays(PassContext& context, const RayBatch& batch, uint32_t voxels,
                     const SurfelsByVoxel& lists, const VoxelPatches& patches, uint32_t isCovered) const;

    Kernel aimAcross_, raise_, pivot_, aim_, join_;
};

}  // namespace voxray
