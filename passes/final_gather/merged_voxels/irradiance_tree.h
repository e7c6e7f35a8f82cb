#pragma once

#include "graph/pass.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/final_gather/merged_voxels/irradiance_tree_types.h"

namespace voxray {

/// Irradiance of voxel faces in k-d trees over the grid, one for each of the six directions; a leaf holds one
/// value for all its voxels. Includes the voxels' occupancy, so that a final gather reads nothing else. GLSL
/// access: passes/final_gather/merged_voxels/irradiance_tree.glsl.
struct IrradianceTree : Resource {
    bool holdsDirect = true;  ///< False: only indirect light. Known from plan() on.
    Buffer header;            ///< The address of `words`, then a gpu::IrradianceTreeGrid.
    Buffer words;             ///< The six trees, one after another (irradiance_tree_types.h).
    Buffer occupancy, rank;   ///< As in SurfaceVoxels.
    Buffer faces;             ///< A byte per surface voxel: a bit for each face that has a value.

    uint64_t bytes() const { return header.bytes() + words.bytes() + occupancy.bytes() + rank.bytes() + faces.bytes(); }
    /// For shaders that include irradiance_tree.glsl.
    std::vector<Binding> bindings() const {
        return {{"irradianceTree", header}, {"voxelOccupancy", occupancy}, {"voxelRank", rank}, {"treeFaces", faces}};
    }
};

}  // namespace voxray
