#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfel_neighbors.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Finds the neighbors of surfels, for smooth_surfels.
class NeighborSearch {
 public:
    explicit NeighborSearch(ProgramOwner& owner);

    /// Lists the surfels within a voxel's size of each surfel. Where these pairs exceed those of flat
    /// surfaces with as many points, the radius shrinks by factors of kRadiusStep until they don't. @param
    /// points that surfels were placed at (Surfels::pointCount). @return the radius, in voxels.
    float run(CommandStream& stream, const SurfaceVoxels& voxels, uint64_t points, const SurfelsByVoxel& surfels,
              SurfelNeighbors& neighbors) const;

 private:
    static constexpr float kRadiusStep = 0.8f;

    /// Counts the pairs within a radius (m), and writes the first of each surfel to neighbors.begins.
    /// @return their number, or an upper bound where it exceeds 32 bits.
    uint64_t countPairs(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& surfels, float radius,
                        SurfelNeighbors& neighbors) const;

    Kernel count_, list_;
    PrefixSum prefixSum_;
};

}  // namespace voxray
