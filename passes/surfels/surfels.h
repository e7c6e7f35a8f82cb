#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/surfels/surfel_types.h"

namespace voxray {

/// Points on the sides of surfaces that open space lies before, spread evenly over their area: where the
/// irradiance of voxels is measured. Each stands for the same area. Covered sides may be among them, with
/// area 0: no voxel's irradiance is theirs.
struct Surfels : Resource {
    std::string indexedBy() const override { return "voxels"; }

    struct Chunk {
        Buffer surfels;  ///< gpu::Surfel each.
        uint32_t count = 0;
    };
    /// Surfels of a chunk, at most.
    static constexpr uint32_t kMaxChunkSurfels = 1u << 18;
    std::vector<Chunk> chunks;
    uint64_t count = 0;               ///< Of all chunks.
    uint64_t pointCount = 0;          ///< Points that were spread: each has a surfel on either side, at most.
    double estimatedCount = 0;        ///< About as many surfels, for estimates of memory. Set in plan().
    bool hasOccludedSurfels = false;  ///< Whether covered sides have surfels. Set in plan().
};

}  // namespace voxray
