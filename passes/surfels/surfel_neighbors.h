#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// The neighbors of each surfel: other surfels of similar normals and equal occlusion within a voxel's size,
/// or less where surfaces are dense. If A is a neighbor of B, B is one of A. Does not depend on light.
struct SurfelNeighbors : Resource {
    std::string indexedBy() const override { return "surfels_by_voxel"; }

    Buffer begins;      ///< By sorted surfel: its first pair; then the number of pairs. uint32_t.
    LargeBuffer pairs;  ///< NeighborPairs (passes/surfels/neighbors.glsl).
};

}  // namespace voxray
