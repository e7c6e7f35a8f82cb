#pragma once

#include <limits>

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/surfels/sorted_surfels.h"

namespace voxray {

/// Surfels sorted by voxel, without those that have no voxel.
struct SurfelsByVoxel : Resource {
    std::string indexedBy() const override { return "voxels"; }

    static constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

    bool hasOccludedSurfels = false;  ///< Set in plan().
    uint32_t sortedCount = 0;
    Buffer ranges;              ///< By voxel: a range [begin, end) of `sorted`; two uint32_t.
    LargeBuffer sorted;         ///< gpu::SortedSurfel each; within a voxel by ascending id.
    LargeBuffer packed;         ///< PackedSurfels (packed_surfel.glsl) in the same order; 8 bytes each.
    LargeBuffer sortedIndices;  ///< By surfel of Surfels: its index in `sorted`, or kNone; uint32_t.
};

/// Light that arrives at surfels, in the order of SurfelsByVoxel::sorted.
struct SurfelIrradiance : Resource {
    std::string indexedBy() const override { return "surfels_by_voxel"; }

    LargeBuffer lit;             ///< LitSurfels (packed_surfel.glsl): indirect irradiance, W/m²; 16 bytes each.
    float relativeVariance = 0;  ///< Of a surfel's irradiance before smooth_surfels, roughly. Set in plan().
};

}  // namespace voxray
