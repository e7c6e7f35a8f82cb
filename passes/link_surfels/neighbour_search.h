#pragma once

#include <optional>

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/surfels/surfel_neighbours.h"
#include "passes/common/surfels/surfels_by_voxel.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Finds the surfels around each surfel, for smooth_surfels.
class NeighbourSearch {
 public:
    /// Reserves what is expected: voxels that surfels lie in as on a flat surface.
    static void plan(PassPlan& plan, const SurfelsByVoxel& surfels, uint64_t voxels);
    void prepare(PassSetup& setup);

    /// @throws Error where there are more pairs of neighbours than can be numbered.
    void run(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& surfels,
             SurfelNeighbours& to) const;

 private:
    Program count_, list_;
    std::optional<PrefixSum> prefixSum_;
};

}  // namespace voxray
