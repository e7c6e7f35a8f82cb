#pragma once

#include <vector>

#include "passes/common/clusters/voxel_patches.h"
#include "passes/common/view/gbuffer.h"

namespace voxray {

/// Which voxels come into the camera's view. Source: Cosin and Patow 2022, section 4.4, which looks at 12
/// points round each voxel; these are the voxels that a lookup at what the camera sees reads.
class SeenVoxels {
 public:
    /// How many voxels were not seen before, and how many sides they reach.
    struct Found {
        uint32_t voxelCount = 0;
        /// The first so many of sides() are within 0, 1 ... steps from neighbour to neighbour.
        std::vector<uint32_t> sidesWithin;
    };

    static void plan(PassPlan& plan, uint64_t voxels);
    void prepare(PassSetup& setup);
    /// Nothing has been seen. Makes the buffers.
    void reset(PassContext& context, const SurfaceVoxels& voxels, const VoxelPatches& patches);
    /// @param reach voxels along each axis round what the camera sees. @param steps from neighbour to
    /// neighbour. Waits for the device.
    Found find(PassContext& context, const GBuffer& gbuffer, const SurfaceVoxels& voxels,
               const VoxelPatches& patches, uint32_t reach, uint32_t steps) const;

    /// Numbers of voxels, and of open sides, that find() has found last.
    const Buffer& voxels() const { return found_; }
    const Buffer& sides() const { return listed_; }

 private:
    Program mark_, listSides_, spread_;
    Sampler sampler_;
    Buffer asked_;  ///< By voxel, bits: it was seen, and all those round it.
    Buffer found_, listed_, reached_, count_;
};

}  // namespace voxray
