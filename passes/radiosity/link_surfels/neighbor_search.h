#pragma once

#include "passes/common/compute/prefix_sum.h"
#include "passes/common/voxels/voxels.h"
#include "passes/surfels/surfel_neighbors.h"
#include "passes/surfels/surfels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Finds the neighbors of surfels, for smooth_surfels.
class NeighborSearch {
 public:
    explicit NeighborSearch(ProgramOwner& owner);

    /// @param moves whether surfaces move, so that lists are kept from frame to frame.
    void plan(SurfelNeighbors& neighbors, bool moves);

    /// Lists the surfels within a voxel's size of each surfel. Where these pairs exceed those of flat
    /// surfaces with as many points, the radius shrinks by factors of kRadiusStep until they don't.
    void run(CommandStream& stream, const SurfaceVoxels& voxels, const Surfels& surfels, const SurfelsByVoxel& byVoxel,
             SurfelNeighbors& neighbors);
    /// Brings the lists of the run before to what run() would make, by those of surfels near a change. Where that
    /// can't be, it is run().
    /// @param boxes changedBoxes(). @param reach distance, in m, within which a change affects whether a surfel exists.
    void update(CommandStream& stream, const SurfaceVoxels& voxels, const Surfels& surfels,
                const SurfelsByVoxel& byVoxel, const Buffer& boxes, float reach, SurfelNeighbors& neighbors);

 private:
    static constexpr float kRadiusStep = 0.8f;

    /// Counts the pairs within the radius, by node in `counts`. @return their number.
    uint64_t countPairs(CommandStream& stream, const SurfaceVoxels& voxels, const SurfelsByVoxel& byVoxel,
                        const SurfelNeighbors& neighbors, const Buffer& counts) const;
    /// Lists surfels near a change. @return their number.
    uint32_t listChanged(CommandStream& stream, const Surfels& surfels, const Buffer& boxes, float reach,
                         const Buffer& listed) const;

    Kernel count_, list_, listChanged_, update_;
    PrefixSum prefixSum_;
    bool moves_ = false;
    Buffer places_;  ///< Where surfaces move: pairs that each list has room for, by node.
    Buffer used_;    ///< Likewise: pairs, and places of all lists.
};

}  // namespace voxray
