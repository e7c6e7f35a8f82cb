#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/triangle_voxelizer/voxel_region.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Replaces the voxels of a region by rebuilt ones. Voxels outside the region retain their materials; their
/// numbers change.
class RegionMerge {
 public:
    explicit RegionMerge(ProgramOwner& owner);

    /// A bit for each voxel of a region, laid out as the occupancy of `voxels`. Waits for the device.
    Buffer bits(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& voxels) const;
    /// Merges two occupancies: `rebuilt` within the region of these bits, `previous` elsewhere. Clears
    /// `rebuilt` outside the region.
    Buffer merged(CommandStream& stream, const Buffer& bits, const Buffer& previous, const Buffer& rebuilt) const;
    /// The first step: merges occupancies. Clears that of `rebuilt` outside the region.
    void occupancy(CommandStream& stream, const VoxelRegion& region, const SurfaceVoxels& previous,
                   SurfaceVoxels& rebuilt);
    /// The second step, once `rebuilt` has ranks and materials: merges these. `previous` becomes the result.
    /// Waits for the device.
    void materials(CommandStream& stream, const PrefixSum& prefixSum, const SurfaceVoxels& rebuilt,
                   SurfaceVoxels& previous);

 private:
    Kernel bits_, merge_, materials_;
    Buffer merged_;  ///< Occupancy, between the two steps.
};

}  // namespace voxray
