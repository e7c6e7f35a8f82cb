#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// The surfels around each surfel that look to the same side: those nearer than a voxel's size (or less,
/// where surfaces are dense), without itself. Depends on geometry alone, so that light which is new reads it
/// as it is. If A is a neighbour of B, B is one of A.
struct SurfelNeighbours : Resource {
    std::string indexedBy() const override { return "surfels_by_voxel"; }

    Buffer begins;  ///< By slot: its first pair, and after the last slot the number of pairs; uint32_t.
    /// By pair: the neighbour's slot, and the bias² and the kernel of the pair
    /// (passes/surfels/neighbours.glsl).
    LargeBuffer pairs;
};

}  // namespace voxray
