#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/surfels/surfels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Lists the surfels of each voxel.
class SurfelSort {
 public:
    explicit SurfelSort(ProgramOwner& owner);

    /// Fills the lists. Waits for the device. @param voxels that hold the surfels.
    void run(CommandStream& stream, const Surfels& surfels, uint32_t voxels, SurfelsByVoxel& lists) const;

 private:
    Kernel count_, sort_, order_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
