#pragma once

#include "graph/pass.h"
#include "passes/clusters/surface_group_types.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Surfels, surface groups and patches of voxels, and components of clusters (find_patches):
///
///     voxel   -> surface groups: surfels that look into the same space, e.g. one face of a thin wall
///     group   -> patches: one for each of the six faces at which it has area, numbered by group and face
///     cluster -> components: its connected groups, e.g. what lies on one side of a wall
struct VoxelPatches : Resource {
    std::string indexedBy() const override { return "voxels"; }

    uint32_t groupCount = 0;
    uint32_t patchCount = 0;
    uint32_t surfelCount = 0;
    uint32_t componentCount = 0;
    LargeBuffer surfels;      ///< gpu::GroupedSurfel each, by voxel, group and id.
    LargeBuffer surfelIndex;  ///< By surfel of place_surfels: its index in `surfels`, or NO_GROUP.
    Buffer firstGroup;        ///< By voxel: its first group; then the number of groups.
    Buffer groups;            ///< gpu::SurfaceGroup each.
    LargeBuffer materials;    ///< By group: PackedVoxelMaterial of its surfaces alone.
    Buffer firstNeighbour;    ///< By group: its first element of `neighbours`; then their number.
    LargeBuffer neighbours;   ///< Groups of the 26 voxels around that look into the same space, or NO_GROUP.
    Buffer components;        ///< gpu::ClusterComponent each.
    Buffer memberGroups;      ///< Groups by component, ascending within each.
    Buffer componentOfGroup;  ///< By group: its component, or NO_COMPONENT where its voxel has no cluster.
    /// After an update (moving surfaces): by group its index in the build before, or NO_GROUP where its voxel
    /// has changed. Empty where all is new.
    Buffer previousGroups;

    /// Frees the buffers.
    void clear() {
        surfels = {}, surfelIndex = {}, firstGroup = {}, groups = {}, materials = {}, firstNeighbour = {};
        neighbours = {}, components = {}, memberGroups = {}, componentOfGroup = {}, previousGroups = {};
    }
    uint64_t bytes() const {
        return surfels.bytes() + surfelIndex.bytes() + firstGroup.bytes() + groups.bytes() +
               materials.bytes() + firstNeighbour.bytes() + neighbours.bytes() + components.bytes() +
               memberGroups.bytes() + componentOfGroup.bytes() + previousGroups.bytes();
    }
    std::vector<const Buffer*> checkedBuffers() const override { return {&materials}; }
};

}  // namespace voxray
