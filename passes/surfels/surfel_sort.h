#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/surfels/surfels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Lists the surfels of each voxel.
class SurfelSort {
 public:
    explicit SurfelSort(ProgramOwner& owner);

    /// Announces the lists of all surfels. @param voxels that hold them.
    static void plan(PassPlan& plan, const Surfels& surfels, uint64_t voxels, SurfelsByVoxel& lists);
    /// Bytes of the lists without the slots, for a pass that frees them again.
    static uint64_t listBytes(uint64_t surfels, uint64_t voxels);
    /// The most that run() takes besides.
    static uint64_t scratchBytes(uint64_t voxels);
    /// Fills the lists. Waits for the device.
    void run(CommandStream& stream, const Surfels& surfels, uint32_t voxels, SurfelsByVoxel& lists) const;

 private:
    Kernel count_, sort_, order_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
