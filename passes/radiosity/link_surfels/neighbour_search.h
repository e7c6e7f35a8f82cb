#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfel_neighbours.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Finds the surfels around each surfel, for smooth_surfels.
class NeighbourSearch {
 public:
    explicit NeighbourSearch(ProgramOwner& owner);

    /// Lists those within a voxel's size. Where these are more than a flat surface has that cuts through as
    /// many voxels as one can: within the largest of the radii that shrink by kShrink that has no more.
    /// @param points that surfels were placed at (Surfels::pointCount). @return the radius, in voxels.
    float run(CommandStream& stream, const SurfaceVoxels& voxels, uint64_t points,
              const SurfelsByVoxel& surfels, SurfelNeighbours& to) const;

 private:
    static constexpr float kShrink = 0.8f;

    /// Counts the pairs within a radius (m) and leaves the first of each slot in to.begins. @return their
    /// number, which may be larger than can be numbered: then an upper bound.
    uint64_t count(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& surfels,
                   float radius, SurfelNeighbours& to) const;

    Kernel count_, list_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
