#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/surfels/surfels.h"
#include "passes/surfels/surfels_by_voxel.h"

namespace voxray {

/// Mean inverse distances of what surfels see, by which lookups and smoothing know how far a surfel's light reaches.
class MeanDistances {
 public:
    explicit MeanDistances(ProgramOwner& owner);

    /// @param moves whether surfaces move: hits are kept (link_hit.glsl), and their sums.
    void plan(bool moves, uint32_t raysPerSurfel);
    /// Before any other call of a frame.
    void begin(Device& device, const Surfels& surfels, const SurfelsByVoxel& byVoxel);
    /// Measures surfels [first, first + count) of all. @param hits of their rays; @param keptHits of all links, by
    /// which they are measured where surfaces move. @param voxelSize m
    void measure(PassContext& context, const SurfelsByVoxel& byVoxel, const Buffer& hits, const LargeBuffer& keptHits,
                 float voxelSize, uint32_t first, uint32_t count) const;
    /// Packs the means of all surfels with them. Waits for the device.
    void pack(PassContext& context, const SurfelsByVoxel& byVoxel, uint32_t voxels);

    /// Where surfaces move, sums of inverse distances by surfel (mean_inverse_distance.comp).
    const LargeBuffer& sums() const { return sums_; }

 private:
    Kernel measure_, sort_, pack_;
    bool moves_ = false;
    uint32_t raysPerSurfel_ = 0, surfelCount_ = 0;
    LargeBuffer sums_;
    LargeBuffer inverseDistances_;  ///< Of a frame, by sorted surfel.
};

}  // namespace voxray
