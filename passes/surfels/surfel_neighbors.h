#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"

namespace voxray {

/// The neighbors of each surfel: other surfels of similar normals and equal occlusion within a voxel's size,
/// or less where surfaces are dense. If A is a neighbor of B, B is one of A. Depends on where surfels are alone, not
/// on what they see. Nodes are the surfels of SurfelsByVoxel::sorted; where surfaces move, those of Surfels, whose
/// indices stay from frame to frame.
struct SurfelNeighbors : Resource {
    std::string indexedBy() const override { return "surfels_by_voxel"; }

    bool areBySurfel = false;  ///< Whether nodes are the surfels of Surfels. Set in plan().
    uint32_t nodeCount = 0;
    float radius = 1;   ///< Within which neighbors are, in voxels.
    Buffer ranges;      ///< By node: a range [begin, end) of `pairs`; two uint32_t.
    LargeBuffer pairs;  ///< NeighborPairs (passes/surfels/neighbors.glsl). Where surfaces move, some places are unused.
};

}  // namespace voxray
