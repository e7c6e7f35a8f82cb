#pragma once

#include <vector>

#include "graph/pass.h"
#include "passes/surfels/surfel_types.h"

namespace voxray {

/// Surfels (Pfister et al. 2000): points distributed evenly over the area of all surfaces, on both of their
/// sides, where irradiance is measured. All stand for the same area, except for occluded ones, which have
/// another surface within a voxel before them: they stand for none, and are left out of the irradiance of
/// voxels.
struct Surfels : Resource {
    std::string indexedBy() const override { return "voxels"; }

    struct Chunk {
        Buffer surfels;  ///< gpu::Surfel each.
        uint32_t count = 0;
        uint32_t firstIndex = 0;  ///< Number of surfels in the chunks before.
    };
    static constexpr uint32_t kMaxChunkSurfels = 1u << 18;
    std::vector<Chunk> chunks;
    uint64_t count = 0;               ///< Of all chunks.
    uint64_t pointCount = 0;          ///< Of points; each has at most one surfel on either side.
    double estimatedCount = 0;        ///< Of surfels, for estimates of memory. Set in plan().
    bool hasOccludedSurfels = false;  ///< Set in plan().
    /// Set in plan(): surfaces move, and a surfel's index is its id in each frame. What does not exist takes a place
    /// (VOXRAY_NO_SURFEL).
    bool areIndexedById = false;
    bool keepPoints = false;  ///< Whether all points lie on the same triangles as in the frame before.
};

}  // namespace voxray
