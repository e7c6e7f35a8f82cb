#pragma once

#include "passes/common/prefix_sum.h"
#include "passes/common/voxels.h"
#include "passes/voxelize/voxel_region.h"

namespace voxray {

/// Puts the voxels of a region that was made anew in the place of the former ones. Voxels beyond the region
/// keep their materials; only their numbers move.
class RegionJoin {
 public:
    RegionJoin() = default;
    RegionJoin(Device& device, const ShaderCompiler& compiler);

    /// Joins occupancies: drops from `fresh` what lies beyond the region. `former` stays as it is.
    void occupancy(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& former,
                   SurfaceVoxels& fresh);
    /// Then ranks and materials, once the fresh ones are there; `former` becomes the result. Waits for the
    /// device.
    void materials(CommandStream& stream, const PopulationPrefixSum& prefixSum, const SurfaceVoxels& fresh,
                   SurfaceVoxels& former);

    /// Bytes that a join takes for a while, besides the materials of the voxels: five words for every two of
    /// theirs.
    static uint64_t scratchBytes(const SurfaceVoxels& voxels) {
        return 5 * voxels.words() * sizeof(uint32_t);
    }

 private:
    Program bits_, join_, materials_;
    Buffer joined_;  ///< Occupancy, between the two steps.
};

}  // namespace voxray
