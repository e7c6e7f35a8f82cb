#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/triangle_voxelizer/voxel_region.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Puts the voxels of a region that was built again in the place of the previous ones. Voxels beyond the
/// region keep their materials; only their numbers change.
class RegionMerge {
 public:
    explicit RegionMerge(ProgramOwner& owner);

    /// A bit for each voxel of a region, in words as those of `voxels`' occupancy. Waits for the device.
    Buffer bits(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& voxels) const;
    /// An occupancy out of two: `rebuilt` within the region of these bits, and `previous` elsewhere. Drops
    /// from `rebuilt` what lies beyond the region.
    Buffer merged(CommandStream& stream, const Buffer& bits, const Buffer& previous,
                  const Buffer& rebuilt) const;
    /// Merges occupancies: drops from `rebuilt` what lies beyond the region. `previous` stays as it is.
    void occupancy(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& previous,
                   SurfaceVoxels& rebuilt);
    /// Then ranks and materials, once `rebuilt` has them; `previous` becomes the result. Waits for the
    /// device.
    void materials(CommandStream& stream, const PrefixSum& prefixSum, const SurfaceVoxels& rebuilt,
                   SurfaceVoxels& previous);

 private:
    Kernel bits_, merge_, materials_;
    Buffer merged_;  ///< Occupancy, between the two steps.
};

}  // namespace voxray
