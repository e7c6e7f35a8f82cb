#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/surfels/surfels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Sorts surfels by voxel (counting sort), and within a voxel by id.
class SurfelSort {
 public:
    explicit SurfelSort(ProgramOwner& owner);

    /// Fills all of `result` but SurfelsByVoxel::packed. Waits for the device. @param voxels number of
    /// surface voxels.
    void run(CommandStream& stream, const Surfels& surfels, uint32_t voxels, SurfelsByVoxel& result) const;

 private:
    Kernel count_, scatter_, sortVoxel_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
