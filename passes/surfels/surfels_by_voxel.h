#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/surfels/sorted_surfels.h"

namespace voxray {

/// The surfels that lie in each voxel. Surfels without a voxel are left out.
struct SurfelsByVoxel : Resource {
    std::string indexedBy() const override { return "voxels"; }

    bool hasOccludedSurfels = false;  ///< Whether covered sides have surfels. Set in plan().
    uint32_t sortedCount = 0;
    Buffer lists;        ///< By voxel: its first slot, and the one after its last; two uint32_t.
    LargeBuffer sorted;  ///< gpu::SortedSurfel in each slot; within a voxel by rising id.
    LargeBuffer packed;  ///< What lookups read of them (passes/surfels/packed_surfel.glsl): 8 bytes a slot.
    LargeBuffer sortedIndices;  ///< Slot of each surfel by its number, or SurfelLinks::kNone; uint32_t.
};

/// Light that arrives at surfels, in the slots of SurfelsByVoxel.
struct SurfelIrradiance : Resource {
    std::string indexedBy() const override { return "surfels_by_voxel"; }

    LargeBuffer
        lit;  ///< Surfel and its indirect irradiance, W/m² (LitSurfels, packed_surfel.glsl): 12 bytes.
    /// Of a surfel's irradiance, roughly, before smooth_surfels. Set in plan().
    float relativeVariance = 0;
};

}  // namespace voxray
