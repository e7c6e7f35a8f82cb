#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/final_gather/merged_voxels/irradiance_tree_types.h"

namespace voxray {

/// Irradiance by face of a grid's voxels, neighbours that are alike merged: for each of the six faces a k-d
/// tree over the grid, whose leaves hold one value for all voxels in them. All that a final gather reads:
/// which voxels there are is here too. GLSL access: passes/final_gather/merged_voxels/irradiance_tree.glsl.
struct IrradianceTree : Resource {
    bool holdsDirect = true;  ///< False: only light after one bounce or more. Known from plan() on.
    uint32_t leaves = 0;      ///< Of all six trees; known once they have been built.
    Buffer header;            ///< The address of `words`, then a gpu::IrradianceTreeGrid.
    Buffer words;             ///< Of the six trees, one after another (irradiance_tree_types.h).
    Buffer occupancy, rank;   ///< As SurfaceVoxels holds them.
    Buffer faces;             ///< A byte a surface voxel: a bit for each face that knows any light.

    uint64_t bytes() const {
        return header.bytes() + words.bytes() + occupancy.bytes() + rank.bytes() + faces.bytes();
    }
    /// What a shader binds that includes irradiance_tree.glsl.
    std::vector<Binding> bindings() const {
        return {{"irradianceTree", header},
                {"voxelOccupancy", occupancy},
                {"voxelRank", rank},
                {"treeFaces", faces}};
    }
};

}  // namespace voxray
