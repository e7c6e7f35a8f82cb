#pragma once

#include "graph/pass.h"
#include "passes/clusters/surface_group_types.h"
#include "passes/common/compute/large_buffer.h"
#include "passes/common/voxels/voxels.h"

namespace voxray {

/// Surfels, surface groups and patches of voxels, and components of clusters (find_patches):
///
///     voxel     -> surface groups: its surfels that see each other, e.g. those on one face of a thin wall
///     group     -> patches: one for each of the six faces at which it has area, in the order of faces
///     cluster   -> components: its connected groups; a thin wall has one on each of its faces
///     component -> faces: one for each of the six at which one of its groups has a patch
///
/// What follows from the scene is not stored: surfels are evaluated where they are read
/// (passes/surfels/surfel_points.glsl).
struct VoxelPatches : Resource {
    std::string indexedBy() const override { return "voxels"; }

    uint32_t groupCount = 0;
    uint32_t patchCount = 0;
    uint32_t surfelCount = 0;
    uint32_t componentCount = 0;
    uint32_t componentFaceCount = 0;
    LargeBuffer surfelIds;    ///< Surfel::id of each, sorted by voxel, group and id.
    Buffer firstGroup;        ///< First group of each voxel; then the number of groups.
    Buffer groups;            ///< gpu::SurfaceGroup each; then one where surfels and patches end.
    LargeBuffer materials;    ///< gpu::PackedGroupMaterial of each group's surfaces.
    Buffer firstNeighbor;     ///< First element of each group in `neighbors`; then the number of elements.
    LargeBuffer neighbors;    ///< Groups in the 26 voxels around that a group sees, a byte each (neighbors.glsl).
    Buffer components;        ///< gpu::ClusterComponent each; then one where members and faces end.
    Buffer memberGroups;      ///< Groups sorted by component, ascending within each.
    Buffer componentOfGroup;  ///< Component of each group, or NO_COMPONENT where its voxel has no cluster.
    /// After an update for moving surfaces: index of each group in the previous build, or NO_GROUP where its
    /// voxel has changed. Empty after a build from scratch.
    Buffer previousGroupIndex;

    /// The bindings of shaders that process the patches of cluster components.
    std::vector<Binding> componentBindings() const {
        return {{"GroupMaterialsRef", materials.ref()},
                {"groups", groups},
                {"components", components},
                {"memberGroups", memberGroups}};
    }
    /// Frees the buffers.
    void clear() {
        surfelIds = {}, firstGroup = {}, groups = {}, materials = {}, firstNeighbor = {};
        neighbors = {}, components = {}, memberGroups = {}, componentOfGroup = {}, previousGroupIndex = {};
    }
    uint64_t bytes() const {
        return surfelIds.bytes() + firstGroup.bytes() + groups.bytes() + materials.bytes() + firstNeighbor.bytes() +
               neighbors.bytes() + components.bytes() + memberGroups.bytes() + componentOfGroup.bytes() +
               previousGroupIndex.bytes();
    }
    std::vector<const Buffer*> checkedBuffers() const override { return {&materials}; }
};

}  // namespace voxray
